#pragma once
// The paper's merging of pairs into finalists as it is written (3.1.3, 3.1.4), with its remedy for
// splintered sets: every accepted pair of every two cameras joins the closest prior finalist.

#include <algorithm>
#include <memory>
#include <vector>

#include "app/core/acquisition/refine.h"

namespace dottrack::acquisition::test {

class ReferenceMerger {
 public:
  std::vector<Finalist> finalists(std::span<const CameraView> views, double diameter_m) {
    found_.clear();
    views_ = views;
    const auto matcher = std::make_unique<Matcher>();
    const auto pairs = std::make_unique<CandidatePairs>();
    core::AcquisitionCounts counts;
    WorkBudget budget(1ULL << 60U);
    for (std::size_t a = 0; a < views.size(); ++a) {
      for (std::size_t b = a + 1; b < views.size(); ++b) {
        pairs->clear();
        matcher->match(views, a, b, diameter_m, *pairs, counts, budget);
        for (const CandidatePair& pair : *pairs) merge(pair, 2.0 * diameter_m);
      }
    }
    refine();
    unite_splinters();
    return found_;
  }

 private:
  bool in_box(std::size_t camera, std::size_t sighting, const Eigen::Vector3d& point_m) const {
    const estimation::Sighting& s = views_[camera].sightings[sighting];
    return s.box_contains(s.pixel_of(point_m), 0.25, 1.0);
  }

  bool accepts(const Finalist& finalist, const CandidatePair& pair) const {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t camera = pair.camera[side];
      if (finalist.cameras.contains(camera) && !finalist.sees(camera, pair.sighting[side])) {
        return false;
      }
      if (!in_box(camera, pair.sighting[side], finalist.position_m)) return false;
    }
    return true;
  }

  void merge(const CandidatePair& pair, double radius_m) {
    Finalist* closest = nullptr;
    double least_m = radius_m;
    for (Finalist& finalist : found_) {
      const double distance_m = (finalist.position_m - pair.point_m).norm();
      if (distance_m >= least_m || !accepts(finalist, pair)) continue;
      least_m = distance_m;
      closest = &finalist;
    }
    if (closest == nullptr) {
      closest = &found_.emplace_back();
      closest->position_m = pair.point_m;
    } else {
      ++closest->pairs;
      closest->position_m += (pair.point_m - closest->position_m) / closest->pairs;
    }
    for (std::size_t side = 0; side < 2; ++side) {
      closest->cameras.insert(pair.camera[side]);
      closest->sighting[pair.camera[side]] = pair.sighting[side];
    }
  }

  void refine() {
    for (Finalist& f : found_) {
      if (!refine_finalist(views_, {f.cameras, f.sighting}, f)) f.cameras = CameraSet{};
    }
    remove_empty();
  }

  void remove_empty() {
    found_.erase(std::remove_if(found_.begin(), found_.end(),
                                [](const Finalist& f) { return f.cameras.size() < 2; }),
                 found_.end());
  }

  bool fits(const Finalist& finalist, const Eigen::Vector3d& point_m) const {
    for (std::size_t c = 0; c < views_.size(); ++c) {
      if (finalist.cameras.contains(c) && !in_box(c, finalist.sighting[c], point_m)) return false;
    }
    return true;
  }

  static bool compatible(const Finalist& a, const Finalist& b) {
    for (std::size_t c = 0; c < kMaxCameras; ++c) {
      if (a.cameras.contains(c) && b.cameras.contains(c) && a.sighting[c] != b.sighting[c]) {
        return false;
      }
    }
    return true;
  }

  void unite_splinters() {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        Finalist& home = found_[k];
        Finalist& splinter = found_[i];
        if (home.cameras.empty() || splinter.cameras.empty() || !compatible(home, splinter) ||
            !fits(home, splinter.position_m) || !fits(splinter, home.position_m)) {
          continue;
        }
        PointViews all{home.cameras, home.sighting};
        for (std::size_t c = 0; c < views_.size(); ++c) {
          if (splinter.cameras.contains(c)) all.set(c, splinter.sighting[c]);
        }
        refine_finalist(views_, all, home);
        splinter.cameras = CameraSet{};
      }
    }
    remove_empty();
  }

  std::span<const CameraView> views_;
  std::vector<Finalist> found_;
};

}  // namespace dottrack::acquisition::test
