#include "tests/bench/room_views.h"

#include "app/core/geometry/optics.h"

namespace dottrack::bench {
namespace {

// A dot as one camera sees it.
constexpr double kNoise_px = 0.1;

bool look(const core::Camera& camera, const geometry::Optics& optics, const Eigen::Vector3d& point,
          std::mt19937& random, image::Region& region) {
  region = {};
  if (geometry::project(camera.model, point, region.centroid_px) != geometry::OpticsStatus::ok) {
    return false;
  }
  std::normal_distribution<double> noise(0.0, kNoise_px);
  auto& p = region.centroid_px;
  p += Eigen::Vector2d(noise(random), noise(random));
  if (p.x() < 10.0 || p.y() < 10.0 || p.x() > kSetWidth - 10.0 || p.y() > kSetHeight - 10.0) {
    return false;
  }
  const double range_m = (point - geometry::centre(camera.model)).norm();
  const double r = 0.5 * kRoomDiameter_m / range_m * optics.at(p).mean_px();
  region.semi_major_px = region.semi_minor_px = r;
  region.x_min = static_cast<std::int16_t>(p.x() - r);
  region.x_max = static_cast<std::int16_t>(p.x() + r);
  region.y_min = static_cast<std::int16_t>(p.y() - r);
  region.y_max = static_cast<std::int16_t>(p.y() + r);
  return true;
}

bool look(const core::Camera& camera, const geometry::Optics& optics, const Eigen::Vector3d& point,
          std::mt19937& random, estimation::Sighting& sighting) {
  image::Region region;
  if (!look(camera, optics, point, random, region)) return false;
  return estimation::make_sighting(camera, optics, {kRoomDiameter_m, kRoomDiameter_m}, region,
                                   sighting);
}

void take(acquisition::CameraView& view, estimation::Sighting sighting) {
  sighting.region = static_cast<std::uint16_t>(view.sightings.size());
  view.sightings.push_back(sighting);
}

}  // namespace

RoomViews::RoomViews(std::size_t common_dots, std::size_t sightings)
    : rig_(room_rig(4)), views_(rig_.cameras.size()) {
  std::vector<Eigen::Vector3d> dots;
  while (dots.size() < common_dots) dots.push_back(point_in_room(random_));
  for (std::size_t i = 0; i < views_.size(); ++i) {
    acquisition::CameraView& view = views_[i];
    view.camera = &rig_.cameras[i];
    const geometry::Optics optics(view.camera->model, view.camera->width_px,
                                  view.camera->height_px);
    estimation::Sighting sighting;
    for (const Eigen::Vector3d& dot : dots) {
      if (look(*view.camera, optics, dot, random_, sighting)) take(view, sighting);
    }
    while (view.sightings.size() < sightings) {
      if (look(*view.camera, optics, point_in_room(random_), random_, sighting)) {
        take(view, sighting);
      }
    }
  }
}

RoomRegions::RoomRegions(const core::Rig& rig, std::size_t regions) : regions_(rig.cameras.size()) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const core::Camera& camera = rig.cameras[i];
    const geometry::Optics optics(camera.model, camera.width_px, camera.height_px);
    image::Region region;
    for (const core::TargetDot& dot : rig.target.dots) {
      const Eigen::Vector3d place_m = RoomScene::place_m() + dot.position_m;
      if (look(camera, optics, place_m, random_, region)) regions_[i].push_back(region);
    }
    while (regions_[i].size() < regions) {
      if (look(camera, optics, point_in_room(random_), random_, region)) {
        regions_[i].push_back(region);
      }
    }
  }
  for (const image::Regions& seen : regions_) pointers_.push_back(&seen);
}

}  // namespace dottrack::bench
