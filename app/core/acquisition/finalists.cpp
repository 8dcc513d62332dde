#include "app/core/acquisition/finalists.h"

#include <algorithm>
#include <limits>

#include "app/core/acquisition/refine.h"

namespace dottrack::acquisition {
namespace {

// The paper's remedy for splintered sets: bounding boxes widened on each side.
constexpr double kWidenPart = 0.25;
constexpr double kWiden_px = 1.0;

bool conflicts(const Finalist& finalist, const CandidatePair& pair) {
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t camera = pair.camera[side];
    if (finalist.cameras.contains(camera) && !finalist.sees(camera, pair.sighting[side]))
      return true;
  }
  return false;
}

bool falls_into_box(const estimation::Sighting& sighting, const Eigen::Vector3d& position_m) {
  return sighting.box_contains(sighting.pixel_of(position_m), kWidenPart, kWiden_px);
}

bool falls_into_boxes(std::span<const CameraView> views, const CandidatePair& pair,
                      const Eigen::Vector3d& position_m) {
  return falls_into_box(views[pair.camera[0]].sightings[pair.sighting[0]], position_m) &&
         falls_into_box(views[pair.camera[1]].sightings[pair.sighting[1]], position_m);
}

bool compatible(const Finalist& a, const Finalist& b) {
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (a.cameras.contains(camera) && b.cameras.contains(camera) &&
        a.sighting[camera] != b.sighting[camera]) {
      return false;
    }
  }
  return true;
}

// Every view of `finalist` would accept the position as its own.
bool fits(std::span<const CameraView> views, const Finalist& finalist,
          const Eigen::Vector3d& position_m) {
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    if (!finalist.cameras.contains(camera)) continue;
    if (!falls_into_box(views[camera].sightings[finalist.sighting[camera]], position_m)) {
      return false;
    }
  }
  return true;
}

void take_views(Finalist& into, const Finalist& from) {
  for (std::size_t camera = 0; camera < kMaxCameras; ++camera) {
    if (!from.cameras.contains(camera)) continue;
    into.cameras.insert(camera);
    into.sighting[camera] = from.sighting[camera];
  }
  into.pairs += from.pairs;
}

}  // namespace

void FinalistMerger::start(double search_radius_m) {
  finalists_.clear();
  grid_.clear(search_radius_m);
  search_radius_m_ = search_radius_m;
}

void FinalistMerger::merge(std::span<const CameraView> views, const CandidatePair& pair,
                           core::AcquisitionCounts& counts, WorkBudget& budget) {
  std::uint16_t closest = 0;
  double closest2 = search_radius_m_ * search_radius_m_;
  bool any = false;
  std::uint64_t visited = 1;
  grid_.visit_near(pair.point_m, [&](std::uint16_t index) {
    ++visited;
    const Finalist& finalist = finalists_[index];
    const double distance2 = (finalist.position_m - pair.point_m).squaredNorm();
    if (distance2 >= closest2 || conflicts(finalist, pair) ||
        !falls_into_boxes(views, pair, finalist.position_m)) {
      return;
    }
    closest = index;
    closest2 = distance2;
    any = true;
  });
  budget.spend(visited);
  if (any) {
    join(finalists_[closest], closest, pair);
  } else {
    found(pair, counts);
  }
}

void FinalistMerger::found(const CandidatePair& pair, core::AcquisitionCounts& counts) {
  if (finalists_.size() == finalists_.capacity()) {
    ++counts.overflow;
    return;
  }
  const auto index = static_cast<std::uint16_t>(finalists_.size());
  Finalist& finalist = finalists_.emplace_back();
  finalist.position_m = pair.point_m;
  finalist.pairs = 1;
  for (std::size_t side = 0; side < 2; ++side) {
    finalist.cameras.insert(pair.camera[side]);
    finalist.sighting[pair.camera[side]] = pair.sighting[side];
  }
  grid_.insert(index, finalist.position_m);
}

void FinalistMerger::join(Finalist& finalist, std::uint16_t index, const CandidatePair& pair) {
  const Eigen::Vector3d before = finalist.position_m;
  ++finalist.pairs;
  finalist.position_m += (pair.point_m - before) / static_cast<double>(finalist.pairs);
  for (std::size_t side = 0; side < 2; ++side) {
    finalist.cameras.insert(pair.camera[side]);
    finalist.sighting[pair.camera[side]] = pair.sighting[side];
  }
  grid_.move(index, before, finalist.position_m);
}

void FinalistMerger::unite_splinters(std::span<const CameraView> views, WorkBudget& budget) {
  grid_.clear(search_radius_m_);
  for (std::size_t i = 0; i < finalists_.size() && !budget.exhausted(); ++i) {
    Finalist& finalist = finalists_[i];
    if (finalist.cameras.empty()) continue;
    std::uint64_t visited = 1;
    Finalist* home = nullptr;
    grid_.visit_near(finalist.position_m, [&](std::uint16_t index) {
      ++visited;
      Finalist& prior = finalists_[index];
      if (home == nullptr && compatible(prior, finalist) &&
          fits(views, prior, finalist.position_m) && fits(views, finalist, prior.position_m)) {
        home = &prior;
      }
    });
    budget.spend(visited);
    if (home == nullptr) {
      grid_.insert(static_cast<std::uint16_t>(i), finalist.position_m);
      continue;
    }
    const Eigen::Vector3d before = home->position_m;
    take_views(*home, finalist);
    finalist.cameras = CameraSet{};
    if (refine_finalist(views, *home)) {
      grid_.move(static_cast<std::uint16_t>(home - finalists_.data()), before, home->position_m);
    } else {
      home->position_m = before;
    }
  }
}

void FinalistMerger::refine(std::span<const CameraView> views, WorkBudget& budget) {
  for (Finalist& finalist : finalists_) {
    budget.spend(1 + static_cast<std::uint64_t>(finalist.cameras.size()));
    if (!refine_finalist(views, finalist)) finalist.cameras = CameraSet{};
  }
  unite_splinters(views, budget);
  const auto gone = std::remove_if(finalists_.begin(), finalists_.end(),
                                   [](const Finalist& f) { return f.cameras.size() < 2; });
  finalists_.erase(gone, finalists_.end());
}

}  // namespace dottrack::acquisition
