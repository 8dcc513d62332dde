#pragma once
// Finalists: 3-D points that may be dots (paper 3.1.3, 3.1.4), and who owns which sighting.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/acquisition/match.h"
#include "app/core/acquisition/view_finder.h"
#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

struct Finalist {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // world
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  double diameter_m = 0.0;         // mean over its views
  double worst_residual_px = 0.0;  // of its views
  std::uint32_t pairs = 1;         // of sightings that led to it
  CameraSet cameras;
  std::array<std::uint16_t, kMaxCameras> sighting{};  // one a camera, where cameras has it

  bool sees(std::size_t camera, std::size_t index) const {
    return cameras.contains(camera) && sighting[camera] == index;
  }
};

using Finalists = StaticVector<Finalist, core::kMaxFinalists>;

// Finalists by the sightings they own. A sighting may belong to several: a dot, and lines of sight
// that cross by chance.
class FinalistSet {
 public:
  static constexpr std::uint16_t kNone = 0xFFFF;

  void clear();
  const Finalists& finalists() const { return finalists_; }
  bool full() const { return finalists_.size() == finalists_.capacity(); }

  // Which cameras see the finalist: quicker to reach than the finalist.
  CameraSet cameras(std::uint16_t index) const { return cameras_[index]; }

  // Calls visit(index) for every finalist with this sighting, the latest first, until it returns
  // true; whether it did.
  template <class Visit>
  bool visit_owners(std::size_t camera, std::size_t sighting, const Visit& visit) const {
    for (std::uint16_t i = heads_[camera][sighting]; i != kNone; i = next_[i][camera]) {
      if (visit(i)) return true;
    }
    return false;
  }

  void count_pair(std::uint16_t index) { ++finalists_[index].pairs; }

  // False when there is no room.
  bool add(const Finalist& finalist);
  void remove(std::uint16_t index);  // the last one takes its place

 private:
  void link(std::uint16_t index);
  void unlink(std::uint16_t index);

  Finalists finalists_;
  std::array<CameraSet, core::kMaxFinalists> cameras_;
  std::array<std::array<std::uint16_t, core::kMaxRegions>, kMaxCameras> heads_{};
  std::array<std::array<std::uint16_t, kMaxCameras>, core::kMaxFinalists> next_{};
};

}  // namespace dottrack::acquisition
