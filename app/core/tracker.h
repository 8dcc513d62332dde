#pragma once
// The tracker: one call a tick, from images to a pose. Acquires until it finds the target, then
// follows it; when it has lost it for lost_after_ticks, it acquires again (paper section 3).

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "app/core/camera_frame.h"
#include "app/core/image/region.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::core {

// All memory is taken at construction; step() allocates nothing, throws nothing and its work is
// bounded. The same frames give the same results, bit for bit.
class Tracker {
 public:
  explicit Tracker(const Rig& rig);
  ~Tracker();
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  // frames[i] belongs to camera i of the rig. The result stays valid until the next call.
  const TickResult& step(const std::array<CameraFrame, kMaxCameras>& frames);

  // Where the filter has the target at a time after the last frames: not known without a lock.
  FilteredPose predicted(Time at) const;

  // Drops the lock, if there is one: the next step() looks for the target anew.
  void forget();

  // Cameras that are left out because they have been moved count again.
  void readmit_cameras();

  // The regions considered in the last tick: all candidates while acquiring, those in the dots'
  // windows while tracking.
  std::span<const image::Region> regions(std::size_t camera) const;

  // Bytes this tracker occupies, all capacities included.
  std::size_t footprint_bytes() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::core
