#pragma once
// Match, second step: pairs merge into finalists, 3-D points that may be dots (paper 3.1.3, 3.1.4).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/match.h"
#include "app/core/acquisition/point_grid.h"
#include "app/core/acquisition/work_budget.h"
#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

struct Finalist {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();     // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // known after refine()
  double diameter_m = 0.0;                                  // mean over its views, after refine()
  std::uint32_t pairs = 0;
  CameraSet cameras;
  std::array<std::uint16_t, kMaxCameras> sighting{};  // one a camera, where cameras has it

  bool sees(std::size_t camera, std::size_t index) const {
    return cameras.contains(camera) && sighting[camera] == index;
  }
};

using Finalists = StaticVector<Finalist, core::kMaxFinalists>;

class FinalistMerger {
 public:
  // Empties the collection. search_radius_m: how far a pair's point may be from its finalist.
  void start(double search_radius_m);

  // Gives the pair to the closest prior finalist whose position projects into both of the pair's
  // bounding boxes - widened by a quarter and a pixel, the paper's remedy for splintered sets - and
  // that has no other region of these cameras; otherwise founds a new finalist. A finalist's
  // position is the mean of its pairs' points.
  void merge(std::span<const CameraView> views, const CandidatePair& pair,
             core::AcquisitionCounts& counts, WorkBudget& budget);

  // Recomputes every finalist by weighted least squares over all its lines of sight, drops views
  // that it does not project into, unites finalists that fit into each other's views, and removes
  // what is left with fewer than two views (paper 3.1.4, appendix).
  void refine(std::span<const CameraView> views, WorkBudget& budget);

  const Finalists& finalists() const { return finalists_; }

 private:
  void found(const CandidatePair& pair, core::AcquisitionCounts& counts);
  void join(Finalist& finalist, std::uint16_t index, const CandidatePair& pair);
  void unite_splinters(std::span<const CameraView> views, WorkBudget& budget);

  Finalists finalists_;
  PointGrid grid_;
  double search_radius_m_ = 0.0;
};

}  // namespace dottrack::acquisition
