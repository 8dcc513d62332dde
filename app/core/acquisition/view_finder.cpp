#include "app/core/acquisition/view_finder.h"

#include <bit>

namespace dottrack::acquisition {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Square of the sine of the angle between two lines of sight, 10 degrees: noise in them is seen six
// times as large from the side.
constexpr double kVagueSine2 = 0.03;

}  // namespace

bool same_views(const PointViews& a, const PointViews& b) {
  if (a.cameras != b.cameras) return false;
  for (std::size_t c = 0; c < kMaxCameras; ++c) {
    if (a.cameras.contains(c) && a.sighting[c] != b.sighting[c]) return false;
  }
  return true;
}

void ViewFinder::start(std::span<const CameraView> views) {
  views_ = views;
  seeing_ = CameraSet{};
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (views[c].sightings.empty()) continue;
    seeing_.insert(c);
    index_[c].build(views[c]);
    centres_m_[c] = geometry::centre(views[c].camera->model);
  }
  filter_.start(views);
}

PointViews ViewFinder::views_of(const Vector3d& point_m, CameraSet cameras, double radius_px,
                                const PointViews& known, int enough) const {
  PointViews found = known;
  unsigned left = cameras.bits() & ~static_cast<unsigned>(known.cameras.bits());
  int most = CameraSet(static_cast<std::uint16_t>(cameras.bits() | known.cameras.bits())).size();
  for (; left != 0 && most >= enough; left &= left - 1) {
    const auto c = static_cast<std::size_t>(std::countr_zero(left));
    std::uint16_t sighting = SightingIndex::kNone;
    Vector2d pixel;
    if (geometry::project(views_[c].camera->model, point_m, pixel) == geometry::OpticsStatus::ok) {
      sighting = index_[c].closest(pixel, point_m, radius_px);
    }
    if (sighting != SightingIndex::kNone) {
      found.set(c, sighting);
    } else {
      --most;
    }
  }
  return found;
}

PointViews ViewFinder::close_views(const Vector3d& point_m) const {
  return views_of(point_m, look(point_m), kClose_px);
}

bool ViewFinder::is_vague(const CandidatePair& pair) const {
  const Vector3d a = pair.point_m - centres_m_[pair.camera[0]];
  const Vector3d b = pair.point_m - centres_m_[pair.camera[1]];
  const double dot = a.dot(b);
  const double lengths2 = a.squaredNorm() * b.squaredNorm();
  return lengths2 - dot * dot < kVagueSine2 * lengths2;
}

}  // namespace dottrack::acquisition
