#include "app/core/acquisition/finalist_builder.h"

#include <algorithm>
#include <limits>

#include "app/core/acquisition/refine.h"

namespace dottrack::acquisition {
namespace {

// Work units of the steps, about 10 ns each on a desktop core.
constexpr std::uint64_t kLookUnits = 6;       // at a pair, through all cameras
constexpr std::uint64_t kVerifyUnits = 15;    // what they see there
constexpr std::uint64_t kSolveUnits = 150;    // a finalist from its views
constexpr std::uint64_t kSolveTwoUnits = 50;  // from two
constexpr std::uint64_t kVisitsInAUnit = 4;   // of finalists by a sighting

// A finalist is dropped when each of its sightings belongs to one of at least so many times as many
// views: then it is lines of sight to other dots that cross.
constexpr int kManyTimesViews = 2;
constexpr int kManyMoreViews = 3;

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

void FinalistBuilder::start(std::span<const CameraView> views) {
  views_ = views;
  finder_.start(views);
  set_.clear();
}

int FinalistBuilder::take(const CandidatePair& pair, CameraSet look, int min_views,
                          WorkBudget& budget, core::AcquisitionCounts& counts) {
  budget.spend(kLookUnits);
  if (has_finalist(pair, true, budget)) return 0;
  if (set_.full()) {
    ++counts.overflow;
    return 0;
  }
  PointViews alone;
  for (std::size_t side = 0; side < 2; ++side) alone.set(pair.camera[side], pair.sighting[side]);
  const int close =
      CameraSet(static_cast<std::uint16_t>(look.bits() | alone.cameras.bits())).size();
  const bool vague = finder_.is_vague(pair);
  if (close < min_views && !vague) return close;
  budget.spend(kVerifyUnits);
  const PointViews seen = finder_.views_of(
      pair.point_m, vague ? finder_.seeing() : look,
      vague ? std::numeric_limits<double>::infinity() : kClose_px, alone, min_views);
  if (seen.cameras.size() < min_views) return min_views - 1;
  if (seen.cameras.size() > 2) {
    budget.spend(kSolveUnits);
    Finalist finalist;
    if (find_finalist(views_, finder_, seen, pair.point_m, min_views, finalist) &&
        finalist.cameras.size() >= min_views) {
      place(finalist, budget, counts);
      if (has_finalist(pair, false, budget)) return 0;
    }
    if (min_views > 2) return min_views - 1;
  }
  budget.spend(kSolveTwoUnits);
  Finalist finalist;
  if (refine_finalist(views_, alone, finalist)) place(finalist, budget, counts);
  return 0;
}

// Whether a finalist has both sightings and all its views agree.
bool FinalistBuilder::has_finalist(const CandidatePair& pair, bool count, WorkBudget& budget) {
  std::uint64_t visited = 0;
  const bool found = set_.visit_owners(pair.camera[0], pair.sighting[0], [&](std::uint16_t index) {
    ++visited;
    if (!set_.cameras(index).contains(pair.camera[1])) return false;
    const Finalist& finalist = set_.finalists()[index];
    if (!finalist.sees(pair.camera[1], pair.sighting[1]) || !is_sure(finalist)) return false;
    if (count) set_.count_pair(index);
    return true;
  });
  budget.spend(visited / kVisitsInAUnit);
  return found;
}

void FinalistBuilder::place(Finalist finalist, WorkBudget& budget,
                            core::AcquisitionCounts& counts) {
  // Two lines that agree were looked for before; whatever has both is not sure.
  if (finalist.cameras.size() > 2 || !is_sure(finalist)) {
    while (merge_with_prior(finalist, budget)) {
    }
  }
  if (finalist.cameras.empty() || made_of_others(finalist, budget)) return;
  if (!set_.add(finalist)) ++counts.overflow;
}

// Looks for a prior finalist that is the same dot. True when one was taken out of the set, being
// part of `finalist`. When it is the other way round `finalist` is empty afterwards. A finalist
// whose views agree is never part of one whose views do not.
bool FinalistBuilder::merge_with_prior(Finalist& finalist, WorkBudget& budget) {
  const auto bits = finalist.cameras.bits();
  bool first = true;
  for (std::size_t c = 0; c < views_.size(); ++c) {
    if (!finalist.cameras.contains(c)) continue;
    std::uint16_t inside = FinalistSet::kNone;
    set_.visit_owners(c, finalist.sighting[c], [&](std::uint16_t index) {
      budget.spend(1);
      const auto others = set_.cameras(index).bits();
      // What has all of the finalist's sightings has the first of them.
      if (first && (bits & ~others) == 0) {
        const Finalist& prior = set_.finalists()[index];
        if (is_part_of(finalist, prior) && (is_sure(prior) || !is_sure(finalist))) {
          set_.count_pair(index);
          finalist.cameras = CameraSet{};
          return true;
        }
      }
      if ((others & ~bits) != 0) return false;
      const Finalist& prior = set_.finalists()[index];
      if (!is_part_of(prior, finalist) || (is_sure(prior) && !is_sure(finalist))) return false;
      inside = index;
      return true;
    });
    if (finalist.cameras.empty()) return false;
    if (inside != FinalistSet::kNone) {
      finalist.pairs += set_.finalists()[inside].pairs;
      set_.remove(inside);
      return true;
    }
    first = false;
  }
  return false;
}

bool FinalistBuilder::made_of_others(const Finalist& finalist, WorkBudget& budget) const {
  const int own = finalist.cameras.size();
  const int many = std::max(kManyTimesViews * own, own + kManyMoreViews);
  for (std::size_t c = 0; c < views_.size(); ++c) {
    if (!finalist.cameras.contains(c)) continue;
    std::uint64_t visited = 0;
    const bool belongs = set_.visit_owners(c, finalist.sighting[c], [&](std::uint16_t index) {
      ++visited;
      return set_.cameras(index).size() >= many && is_sure(set_.finalists()[index]);
    });
    budget.spend(visited / kVisitsInAUnit);
    if (!belongs) return false;
  }
  return true;
}

void FinalistBuilder::judge(std::uint16_t index, WorkBudget& budget) {
  const Finalist& finalist = set_.finalists()[index];
  budget.spend(1 + static_cast<std::uint64_t>(finalist.cameras.size()));
  if (made_of_others(finalist, budget)) set_.remove(index);
}

}  // namespace dottrack::acquisition
