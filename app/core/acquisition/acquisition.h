#pragma once
// Acquisition: from every camera's regions to the target's dots, without knowing where to look
// (paper section 3.1). Order of work: match, select, locate, and how probably the result is chance;
// identify comes before, the confirming run of tracking after.

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "app/core/acquisition/evidence.h"
#include "app/core/acquisition/select.h"
#include "app/core/acquisition/work_budget.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::acquisition {

struct AcquisitionResult {
  // none: there is a candidate. ambiguous: there is one, and a rival nearly as good. Otherwise why
  // there is no candidate.
  core::Reason reason = core::Reason::too_few_regions;
  CandidateLock candidate;
  core::AcquisitionCounts counts;  // of the whole search; its false-lock probability by itself
};

// One search at a time, in as many steps as its budgets make of it. Dots seen by many cameras are
// looked for first, and the whole target before parts of it, three dots of a larger one at last:
// the search ends with the first candidate that is certain enough, else with the best of all. All
// memory is taken at construction; the rig and the optics must outlive the object.
class Acquisition {
 public:
  Acquisition(const core::Rig& rig, std::span<const geometry::Optics> optics);
  ~Acquisition();
  Acquisition(const Acquisition&) = delete;
  Acquisition& operator=(const Acquisition&) = delete;

  // Begins a search. regions[i]: what identify found in camera i; null or empty for a camera
  // without an image. Nothing of them is needed afterwards. Spends of the budget without asking.
  void start(std::span<const image::Regions* const> regions, WorkBudget& budget);

  // How many of camera i's regions are lines of sight of this search.
  std::size_t sightings(std::size_t camera) const;

  // Goes on until the search has ended (true) or the budget has run out.
  bool go_on(WorkBudget& budget);

  // Ends the search with the best that was found so far; without any its reason is work_budget.
  void stop();

  // A search has begun and has not ended.
  bool busy() const { return stage_ != Stage::ended; }

  // Of the search that has ended last; its counts also while one is under way.
  const AcquisitionResult& result() const;

  // The log odds that dots in this pose are the target, from their places alone, judged beside the
  // finalists of the search that has ended last.
  double log_odds_of_lock(const core::Pose& pose, std::span<const Witness> witnesses) const;

  std::size_t footprint_bytes() const;

 private:
  struct Memory;
  enum class Stage : std::uint8_t { ended, finalists, selection, other_labels, other_places };

  // Each step of the search: false when the budget ran out in it.
  bool step(WorkBudget& budget);
  bool find_finalists(WorkBudget& budget);
  bool select(WorkBudget& budget);
  bool find_rival(WorkBudget& budget);

  void begin_selection();
  void begin_other_labels();
  void begin_other_places();
  void go_on_with_fewer();
  void judge();

  void note(core::Reason reason);
  void add_rival(const CandidateLock& rival);
  std::uint64_t units_to_weigh(const Selection& selection) const;
  core::Reason make_lock(const Selection& selection, WorkBudget& budget, CandidateLock& lock) const;
  double ellipse_evidence(const Selection& selection, const core::Pose& pose) const;
  double rival_score() const;
  std::size_t most_dots() const;  // that a selection is to match, at first and at last
  std::size_t fewest_dots() const;

  const core::Rig* rig_;
  std::span<const geometry::Optics> optics_;
  TargetShape shape_;
  Stage stage_ = Stage::ended;
  bool has_candidate_ = false;
  bool last_resort_ = false;  // three dots of a larger target are looked for
  std::size_t layer_ = 0;     // of kViewLayers
  std::size_t dots_ = 0;      // that the present selection is to match
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::acquisition
