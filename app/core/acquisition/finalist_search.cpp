#include "app/core/acquisition/finalist_search.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "app/core/acquisition/pair_order.h"
#include "app/core/acquisition/refine.h"
#include "app/core/acquisition/view_finder.h"
#include "app/core/geometry/crossover.h"

namespace dottrack::acquisition {
namespace {

// Work units of the steps, about 10 ns each on a desktop core.
constexpr std::uint64_t kLookUnits = 2;     // whether a pair has a finalist already
constexpr std::uint64_t kVerifyUnits = 40;  // what all cameras see at a point
constexpr std::uint64_t kSolveUnits = 200;  // a finalist from its views

// A finalist is dropped when each of its sightings belongs to one of at least so many times as many
// views: then it is lines of sight to other dots that cross.
constexpr int kManyTimesViews = 2;
constexpr int kManyMoreViews = 3;

// A pair whose point fewer cameras see than were asked for.
struct Deferred {
  CameraPair cameras;
  std::array<std::uint16_t, 2> sighting{};
  std::uint8_t most_views = 0;
};

bool conflict(const Finalist& a, const Finalist& b) {
  for (std::size_t c = 0; c < kMaxCameras; ++c) {
    if (a.cameras.contains(c) && b.cameras.contains(c) && a.sighting[c] != b.sighting[c]) {
      return true;
    }
  }
  return false;
}

// Every sighting of a is b's too.
bool is_part_of(const Finalist& a, const Finalist& b) {
  return (a.cameras.bits() & ~b.cameras.bits()) == 0 && !conflict(a, b);
}

}  // namespace

struct FinalistSearch::Memory {
  void start(std::span<const CameraView> all, double diameter_m);
  bool advance(int views_wanted, WorkBudget& budget, core::AcquisitionCounts& counts);

 private:
  void begin_layer(int views_wanted);
  bool step(WorkBudget& budget, core::AcquisitionCounts& counts);
  void match_next(WorkBudget& budget, core::AcquisitionCounts& counts);
  void take_pair(WorkBudget& budget, core::AcquisitionCounts& counts);
  void take_deferred(WorkBudget& budget, core::AcquisitionCounts& counts);
  void judge_next(WorkBudget& budget);

  int look_at(const CandidatePair& pair, WorkBudget& budget, core::AcquisitionCounts& counts);
  bool has_finalist(const CandidatePair& pair, bool count);
  void place(Finalist finalist, WorkBudget& budget, core::AcquisitionCounts& counts);
  bool merge_with_prior(Finalist& finalist, WorkBudget& budget);
  bool made_of_others(const Finalist& finalist) const;

  std::span<const CameraView> views;
  double largest_diameter_m = 0.0;
  Matcher matcher;
  ViewFinder finder;
  PairOrder order;

 public:
  FinalistSet set;

 private:
  // Where the search is. A layer looks at what was deferred, then at pairs of cameras, and at last
  // at its finalists once more.
  int min_views = 0;  // 0: nothing was asked for yet
  bool complete = false;
  std::array<CameraSet, kMaxCameras> done;   // pairs of cameras that were matched
  std::array<CameraSet, kMaxCameras> again;  // and have to be once more: no room to defer theirs
  CameraPairs cameras;                       // to match in this layer
  std::size_t next_cameras = 0;
  std::size_t next_sighting = 0;  // of the first of the cameras being matched
  CandidatePairs pairs;           // of one pair of cameras
  std::size_t next_pair = 0;
  std::size_t pairs_ready = 0;  // none before all of the two cameras' are known
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
  finder.start(all);
  order.start(all);
  set.clear();
  min_views = 0;
  done = {};
  again = {};
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
  counts.finalists = static_cast<std::uint32_t>(set.finalists().size());
  return complete;
}

void FinalistSearch::Memory::begin_layer(int views_wanted) {
  const int was = min_views;
  min_views = views_wanted;
  complete = false;
  if (min_views > 2) {
    for (std::size_t a = 0; a < kMaxCameras; ++a) {
      done[a] = CameraSet(static_cast<std::uint16_t>(done[a].bits() & ~again[a].bits()));
    }
  } else {  // every pair counts now, however far its lines miss each other
    done = {};
    deferred.clear();
  }
  if (was == 0 || min_views == 2) {
    matcher.start(min_views > 2 ? kSureResidual_px : std::numeric_limits<double>::infinity());
  }
  again = {};
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
    left_to_judge = set.finalists().size();
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
  const CandidatePair& pair = pairs[next_pair++];
  const int most_views = look_at(pair, budget, counts);
  if (most_views < 2) return;
  const Deferred entry{
      {pair.camera[0], pair.camera[1]}, pair.sighting, static_cast<std::uint8_t>(most_views)};
  if (!try_push_back(deferred, entry)) again[pair.camera[0]].insert(pair.camera[1]);
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
    most_views = look_at(pair, budget, counts);
  } else {
    budget.spend(1);
  }
  if (most_views >= 2) {
    entry.most_views = static_cast<std::uint8_t>(most_views);
    deferred[deferred_kept++] = entry;
  }
  if (next_deferred == deferred_before) deferred.resize(deferred_kept);
}

// Looks for the finalist of a pair. Answers how many views a finalist of this pair that was not
// found now may have at most; 0: there is none but what was found.
int FinalistSearch::Memory::look_at(const CandidatePair& pair, WorkBudget& budget,
                                    core::AcquisitionCounts& counts) {
  budget.spend(kLookUnits);
  if (has_finalist(pair, true)) return 0;
  if (set.full()) {
    ++counts.overflow;
    return 0;
  }
  PointViews alone;
  for (std::size_t side = 0; side < 2; ++side) alone.set(pair.camera[side], pair.sighting[side]);
  const CameraSet look = finder.look(pair.point_m);
  const int close = std::popcount(static_cast<unsigned>(look.bits() | alone.cameras.bits()));
  const bool vague = finder.is_vague(pair);
  if (close < min_views && !vague) return close;
  budget.spend(kVerifyUnits);
  const PointViews seen = finder.views_of(
      pair.point_m, vague ? finder.seeing() : look,
      vague ? std::numeric_limits<double>::infinity() : kClose_px, alone, min_views);
  if (seen.cameras.size() < min_views) return min_views - 1;
  budget.spend(kSolveUnits);
  Finalist finalist;
  if (find_finalist(views, finder, seen, pair.point_m, min_views, finalist) &&
      finalist.cameras.size() >= min_views) {
    place(finalist, budget, counts);
    if (has_finalist(pair, false)) return 0;
  }
  if (min_views > 2) return min_views - 1;
  if (refine_finalist(views, alone, finalist)) place(finalist, budget, counts);
  return 0;
}

// Whether a finalist has both sightings and all its views agree.
bool FinalistSearch::Memory::has_finalist(const CandidatePair& pair, bool count) {
  return set.visit_owners(pair.camera[0], pair.sighting[0], [&](std::uint16_t index) {
    if (!set.cameras(index).contains(pair.camera[1])) return false;
    const Finalist& finalist = set.finalists()[index];
    if (!finalist.sees(pair.camera[1], pair.sighting[1]) || !is_sure(finalist)) return false;
    if (count) set.count_pair(index);
    return true;
  });
}

void FinalistSearch::Memory::place(Finalist finalist, WorkBudget& budget,
                                   core::AcquisitionCounts& counts) {
  while (merge_with_prior(finalist, budget)) {
  }
  if (finalist.cameras.empty() || made_of_others(finalist)) return;
  if (!set.add(finalist)) ++counts.overflow;
}

// Looks for a prior finalist that is the same dot. True when one was taken out of the set, being
// part of `finalist`. When it is the other way round `finalist` is empty afterwards. A finalist
// whose views agree is never part of one whose views do not.
bool FinalistSearch::Memory::merge_with_prior(Finalist& finalist, WorkBudget& budget) {
  const auto bits = finalist.cameras.bits();
  bool first = true;
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (!finalist.cameras.contains(c)) continue;
    std::uint16_t inside = FinalistSet::kNone;
    set.visit_owners(c, finalist.sighting[c], [&](std::uint16_t index) {
      budget.spend(1);
      const auto others = set.cameras(index).bits();
      // What has all of the finalist's sightings has the first of them.
      if (first && (bits & ~others) == 0) {
        const Finalist& prior = set.finalists()[index];
        if (is_part_of(finalist, prior) && (is_sure(prior) || !is_sure(finalist))) {
          set.count_pair(index);
          finalist.cameras = CameraSet{};
          return true;
        }
      }
      if ((others & ~bits) != 0) return false;
      const Finalist& prior = set.finalists()[index];
      if (!is_part_of(prior, finalist) || (is_sure(prior) && !is_sure(finalist))) return false;
      inside = index;
      return true;
    });
    if (finalist.cameras.empty()) return false;
    if (inside != FinalistSet::kNone) {
      finalist.pairs += set.finalists()[inside].pairs;
      set.remove(inside);
      return true;
    }
    first = false;
  }
  return false;
}

bool FinalistSearch::Memory::made_of_others(const Finalist& finalist) const {
  const int own = finalist.cameras.size();
  const int many = std::max(kManyTimesViews * own, own + kManyMoreViews);
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (!finalist.cameras.contains(c)) continue;
    const bool belongs = set.visit_owners(c, finalist.sighting[c], [&](std::uint16_t index) {
      return set.cameras(index).size() >= many && is_sure(set.finalists()[index]);
    });
    if (!belongs) return false;
  }
  return true;
}

// From the last to the first: what takes the place of one that is dropped has been judged.
void FinalistSearch::Memory::judge_next(WorkBudget& budget) {
  const std::size_t index = --left_to_judge;
  const Finalist& finalist = set.finalists()[index];
  budget.spend(1 + static_cast<std::uint64_t>(finalist.cameras.size()));
  if (made_of_others(finalist)) set.remove(static_cast<std::uint16_t>(index));
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
  return memory_->set.finalists();
}

std::size_t FinalistSearch::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory);
}

}  // namespace dottrack::acquisition
