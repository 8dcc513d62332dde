#include "app/core/acquisition/finalist_search.h"

#include <algorithm>
#include <limits>

#include "app/core/acquisition/finalist_builder.h"
#include "app/core/acquisition/pair_order.h"
#include "app/core/acquisition/refine.h"
#include "app/core/geometry/crossover.h"

namespace dottrack::acquisition {
namespace {

// With two views a pair is not deferred: the search for two takes all pairs anew.
constexpr int kLeastDeferred = 3;

// Pairs are looked at so many at a time.
constexpr std::size_t kLookedAtOnce = 32;

// A pair whose point fewer cameras see than were asked for.
struct Deferred {
  CameraPair cameras;
  std::array<std::uint16_t, 2> sighting{};
  std::uint8_t most_views = 0;
};

}  // namespace

struct FinalistSearch::Memory {
  void start(std::span<const CameraView> all, double diameter_m);
  bool advance(int views_wanted, WorkBudget& budget, core::AcquisitionCounts& counts);
  void begin_layer(int views_wanted);
  bool step(WorkBudget& budget, core::AcquisitionCounts& counts);
  void match_next(WorkBudget& budget, core::AcquisitionCounts& counts);
  void take_pair(WorkBudget& budget, core::AcquisitionCounts& counts);
  void take_deferred(WorkBudget& budget, core::AcquisitionCounts& counts);
  void judge_next(WorkBudget& budget);

  std::span<const CameraView> views;
  double largest_diameter_m = 0.0;
  Matcher matcher;
  PairOrder order;
  FinalistBuilder builder;

  // Where the search is. A layer looks at what was deferred, then at pairs of cameras, and at last
  // at its finalists once more.
  int min_views = 0;  // 0: nothing was asked for yet
  bool complete = false;
  std::array<CameraSet, kMaxCameras> done;  // pairs of cameras that were matched
  CameraPairs cameras;                      // to match in this layer
  std::size_t next_cameras = 0;
  std::size_t next_sighting = 0;  // of the first of the cameras being matched
  CandidatePairs pairs;           // of one pair of cameras
  std::size_t next_pair = 0;
  std::size_t pairs_ready = 0;                 // none before all of the two cameras' are known
  std::array<CameraSet, kLookedAtOnce> looks;  // of the pairs from a multiple of their number on
  StaticVector<Deferred, 65536> deferred;
  std::size_t next_deferred = 0;
  std::size_t deferred_before = 0;  // when the layer began
  std::size_t deferred_kept = 0;    // of those, so far
  std::size_t left_to_judge = 0;
  bool judging = false;
};

void FinalistSearch::Memory::start(std::span<const CameraView> all, double diameter_m) {
  views = all;
  largest_diameter_m = diameter_m;
  builder.start(all);
  order.start(all);
  min_views = 0;
  done = {};
  deferred.clear();
}

bool FinalistSearch::Memory::advance(int views_wanted, WorkBudget& budget,
                                     core::AcquisitionCounts& counts) {
  if (min_views == 0) begin_layer(views_wanted);
  for (;;) {
    while (!complete && !budget.exhausted()) complete = !step(budget, counts);
    if (!complete || min_views <= views_wanted) break;
    begin_layer(views_wanted);
  }
  counts.finalists = static_cast<std::uint32_t>(builder.finalists().size());
  return complete;
}

void FinalistSearch::Memory::begin_layer(int views_wanted) {
  const int was = min_views;
  min_views = views_wanted;
  complete = false;
  if (min_views == 2) {  // every pair counts now, however far its lines miss each other
    done = {};
    deferred.clear();
  }
  if (was == 0 || min_views == 2) {
    matcher.start(min_views > 2 ? kSureResidual_px : std::numeric_limits<double>::infinity());
  }
  order.list(min_views, done, cameras);
  next_cameras = 0;
  next_sighting = 0;
  next_pair = 0;
  pairs_ready = 0;
  next_deferred = 0;
  deferred_before = deferred.size();
  deferred_kept = 0;
  judging = false;
}

// One step of the layer; false when there is nothing left to do.
bool FinalistSearch::Memory::step(WorkBudget& budget, core::AcquisitionCounts& counts) {
  if (next_deferred < deferred_before) {
    take_deferred(budget, counts);
  } else if (next_pair < pairs_ready) {
    take_pair(budget, counts);
  } else if (next_cameras < cameras.size()) {
    match_next(budget, counts);
  } else if (!judging) {
    judging = true;
    left_to_judge = builder.finalists().size();
  } else if (left_to_judge > 0) {
    judge_next(budget);
  } else {
    return false;
  }
  return true;
}

void FinalistSearch::Memory::match_next(WorkBudget& budget, core::AcquisitionCounts& counts) {
  const CameraPair& c = cameras[next_cameras];
  if (next_sighting == 0) pairs.clear();
  pairs_ready = 0;
  budget.spend(1);
  if (!matcher.match(views, c.a, c.b, largest_diameter_m, pairs, counts, budget, next_sighting)) {
    return;
  }
  done[c.a].insert(c.b);
  ++next_cameras;
  next_sighting = 0;
  next_pair = 0;
  pairs_ready = pairs.size();
}

void FinalistSearch::Memory::take_pair(WorkBudget& budget, core::AcquisitionCounts& counts) {
  const std::size_t of_look = next_pair % kLookedAtOnce;
  if (of_look == 0) {
    const std::size_t count = std::min(kLookedAtOnce, pairs_ready - next_pair);
    builder.look(as_span(pairs).subspan(next_pair, count), looks);
  }
  const CandidatePair& pair = pairs[next_pair++];
  const int most_views = builder.take(pair, looks[of_look], min_views, budget, counts);
  if (most_views < kLeastDeferred) return;
  const Deferred entry{
      {pair.camera[0], pair.camera[1]}, pair.sighting, static_cast<std::uint8_t>(most_views)};
  if (!try_push_back(deferred, entry)) ++counts.overflow;
}

void FinalistSearch::Memory::take_deferred(WorkBudget& budget, core::AcquisitionCounts& counts) {
  Deferred entry = deferred[next_deferred++];
  int most_views = entry.most_views;
  if (most_views >= min_views) {
    CandidatePair pair;
    pair.camera = {entry.cameras.a, entry.cameras.b};
    pair.sighting = entry.sighting;
    const auto& ray_a = views[entry.cameras.a].sightings[entry.sighting[0]].line.ray;
    const auto& ray_b = views[entry.cameras.b].sightings[entry.sighting[1]].line.ray;
    geometry::Crossover cross;
    geometry::closest_crossover(ray_a, ray_b, cross);  // ok, as it was before
    pair.point_m = cross.point_m;
    CameraSet look;
    builder.look({&pair, 1}, {&look, 1});
    most_views = builder.take(pair, look, min_views, budget, counts);
  } else {
    budget.spend(1);
  }
  if (most_views >= kLeastDeferred) {
    entry.most_views = static_cast<std::uint8_t>(most_views);
    deferred[deferred_kept++] = entry;
  }
  if (next_deferred == deferred_before) deferred.resize(deferred_kept);
}

// From the last to the first: what takes the place of one that is dropped has been judged.
void FinalistSearch::Memory::judge_next(WorkBudget& budget) {
  builder.judge(static_cast<std::uint16_t>(--left_to_judge), budget);
}

FinalistSearch::FinalistSearch() : memory_(std::make_unique<Memory>()) {}

FinalistSearch::~FinalistSearch() = default;

void FinalistSearch::start(std::span<const CameraView> views, double largest_diameter_m) {
  memory_->start(views, largest_diameter_m);
}

bool FinalistSearch::advance(int min_views, WorkBudget& budget, core::AcquisitionCounts& counts) {
  return memory_->advance(min_views, budget, counts);
}

const Finalists& FinalistSearch::finalists() const {
  return memory_->builder.finalists();
}

std::size_t FinalistSearch::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory);
}

}  // namespace dottrack::acquisition
