#include "tests/bench/room_scene.h"

#include "app/core/geometry/camera_model.h"

namespace dottrack::bench {

namespace {

using Eigen::Vector3d;

constexpr double kFocal_px = 450.0;
constexpr double kDiameter_m = 0.1;
constexpr std::size_t kClutterDiscs = 40;

core::Camera ceiling_camera(const Vector3d& place, const Vector3d& towards) {
  const Vector3d axis = (towards - place).normalized();
  const Vector3d right = axis.cross(Vector3d::UnitZ()).normalized();
  geometry::Cahvor model;
  model.c = place;
  model.a = axis;
  model.h = kFocal_px * right + 319.5 * axis;
  model.v = kFocal_px * axis.cross(right) + 239.5 * axis;
  model.o = axis;
  model.r = {0.0, -0.03, 0.005};
  core::Camera camera;
  camera.model = model;
  camera.width_px = kSetWidth;
  camera.height_px = kSetHeight;
  camera.distance_min_m = 2.0;
  camera.distance_max_m = 14.0;
  camera.intensity_min_dn = kBandMin;
  return camera;
}

const std::array<Vector3d, 8> kLayout = {
    Vector3d(0.45, 0.30, 0.0),   Vector3d(-0.50, 0.25, 0.0),  Vector3d(-0.35, -0.33, 0.05),
    Vector3d(0.30, -0.20, 0.0),  Vector3d(0.05, 0.42, 0.0),   Vector3d(0.60, -0.40, 0.02),
    Vector3d(-0.10, -0.05, 0.1), Vector3d(-0.62, -0.10, 0.0),
};

}  // namespace

core::Rig room_rig(std::size_t dots) {
  core::Rig rig;
  for (std::size_t i = 0; i < kRoomCameras; ++i) {
    const double x = 1.0 + 4.0 * static_cast<double>(i % 6);
    const double y = i < 6 ? 0.0 : 9.0;
    rig.cameras.push_back(ceiling_camera({x, y, 5.0}, {0.7 * x + 0.3 * 11.0, 4.5, 0.0}));
  }
  for (std::size_t i = 0; i < dots; ++i) rig.target.dots.push_back({kLayout[i], kDiameter_m, {}});
  return rig;
}

Vector3d point_in_room(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const double x = 22.0 * part(random);
  const double y = 9.0 * part(random);
  return {x, y, part(random)};
}

RoomScene::RoomScene(std::size_t dots) : rig_(room_rig(dots)) {
  for (Picture& picture : pictures_) {
    picture.darken(random_);
    paint_clutter(picture, random_);
  }
  for (std::size_t k = 0; k < kClutterDiscs; ++k) {
    const Vector3d place = point_in_room(random_);
    for (std::size_t i = 0; i < kRoomCameras; ++i) paint_disc(i, place, kDiameter_m);
  }
  for (const core::TargetDot& dot : rig_.target.dots) {
    for (std::size_t i = 0; i < kRoomCameras; ++i) {
      paint_disc(i, place_m() + dot.position_m, dot.diameter_m);
    }
  }
}

// A disc that faces the camera.
void RoomScene::paint_disc(std::size_t camera, const Vector3d& place, double diameter_m) {
  const geometry::CameraModel& model = rig_.cameras[camera].model;
  Eigen::Vector2d pixel;
  if (geometry::project(model, place, pixel) != geometry::OpticsStatus::ok) return;
  if (!(pixel.cwiseAbs().maxCoeff() < 2000.0)) return;
  const double radius = 0.5 * diameter_m * kFocal_px / (place - geometry::centre(model)).norm();
  pictures_[camera].ellipse(pixel.x(), pixel.y(), radius, radius, random_);
}

std::array<core::CameraFrame, kMaxCameras> RoomScene::frames() const {
  std::array<core::CameraFrame, kMaxCameras> frames{};
  for (std::size_t i = 0; i < kRoomCameras; ++i) frames[i] = {true, pictures_[i].view(), {}};
  return frames;
}

}  // namespace dottrack::bench
