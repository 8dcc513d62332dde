#pragma once
// Acquisition: from every camera's regions to the target's dots, without knowing where to look
// (paper section 3.1). Order of work: match, select, locate; identify comes before, the confirming
// run of tracking after.

#include <array>
#include <memory>
#include <span>

#include "app/core/acquisition/select.h"
#include "app/core/estimation/locate.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::acquisition {

// The 2-D gate of one camera's whole image, from its distance range and the target's dots (3.1.2).
image::RegionGate acquisition_gate(const core::Camera& camera, const geometry::Optics& optics,
                                   const core::Target& target);

struct AcquisitionResult {
  core::Reason reason = core::Reason::too_few_regions;  // none: the target was found
  core::Pose pose;                                      // when found
  core::AcquisitionCounts counts;
};

// All memory is taken at construction; the rig and the optics must outlive the object.
class Acquisition {
 public:
  Acquisition(const core::Rig& rig, std::span<const geometry::Optics> optics);
  ~Acquisition();
  Acquisition(const Acquisition&) = delete;
  Acquisition& operator=(const Acquisition&) = delete;

  // regions[i]: what identify found in camera i; null or empty for a camera without an image.
  AcquisitionResult acquire(std::span<const image::Regions* const> regions);

  std::size_t footprint_bytes() const;

 private:
  struct Memory;

  void take_sightings(std::span<const image::Regions* const> regions);
  void match(core::AcquisitionCounts& counts, WorkBudget& budget);
  core::Reason select(int min_views, WorkBudget& budget, Selection& selection);
  bool has_rival_labelling(const Selection& selection, WorkBudget& budget);
  core::Reason judge(const Selection& selection, WorkBudget& budget, AcquisitionResult& result);
  core::Reason select_and_locate(WorkBudget& budget, AcquisitionResult& result);

  const core::Rig* rig_;
  std::span<const geometry::Optics> optics_;
  TargetShape shape_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::acquisition
