#pragma once
// Match, first step: candidate pairs between cameras (paper section 3.1.3).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "app/core/acquisition/pair_filter.h"
#include "app/core/acquisition/ray_arrays.h"
#include "app/core/acquisition/work_budget.h"
#include "app/core/estimation/sighting.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

// One camera's part in an acquisition: its model and what it sees.
struct CameraView {
  const core::Camera* camera = nullptr;
  estimation::Sightings sightings;
};

// One sighting in each of two cameras that may be the same dot.
struct CandidatePair {
  std::array<std::uint8_t, 2> camera{};
  std::array<std::uint16_t, 2> sighting{};
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  // mean point of closest crossover, world
};

using CandidatePairs = StaticVector<CandidatePair, 8192>;

// The first gate that refused a pair, in the paper's order.
enum class PairGate : std::uint8_t {
  accepted,
  collinear,
  behind,
  distance,      // outside a camera's distance limits
  miss,          // the lines pass further apart than the largest dot is wide
  size,          // a region has not the size of a dot at that distance
  reprojection,  // the crossover does not project into both bounding boxes
};

PairGate test_pair(const CameraView& a, std::size_t sighting_a, const CameraView& b,
                   std::size_t sighting_b, double max_miss_m, CandidatePair& pair);

// Finds all pairs of sightings of two cameras that test_pair accepts.
class Matcher {
 public:
  // Forgets what was prepared of the views: to be called whenever sightings have changed. Besides
  // what test_pair asks for, a pair's point has to project to within max_residual_px of both
  // sightings; what does not counts as refused for its reprojection.
  void start(double max_residual_px = std::numeric_limits<double>::infinity());

  // Appends all accepted pairs between cameras a and b (indices into views), in the order of a's
  // and then b's sightings, from a's sighting `next` on. True when done; false when the budget ran
  // out: go on by calling again with the same `next`. Every call that finds budget left tests at
  // least one of a's sightings. Pairs beyond capacity are counted as overflow, not kept.
  bool match(std::span<const CameraView> views, std::size_t a, std::size_t b, double max_miss_m,
             CandidatePairs& pairs, core::AcquisitionCounts& counts, WorkBudget& budget,
             std::size_t& next);

  // The same from a's first sighting on, of views that may have changed since the last call.
  void match(std::span<const CameraView> views, std::size_t a, std::size_t b, double max_miss_m,
             CandidatePairs& pairs, core::AcquisitionCounts& counts, WorkBudget& budget);

 private:
  const RayArrays& rays(std::span<const CameraView> views, std::size_t camera);

  std::array<RayArrays, kMaxCameras> rays_;
  CameraSet prepared_;
  double max_residual_px_ = std::numeric_limits<double>::infinity();
  PairFilter filter_;
};

}  // namespace dottrack::acquisition
