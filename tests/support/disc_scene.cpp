#include "tests/support/disc_scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>

#include "app/config/camera_file.h"

namespace dottrack::test {
namespace {

constexpr int kWidth_px = 400;
constexpr int kHeight_px = 300;
constexpr double kFocal_px = 420.0;
constexpr double kDiameter_m = 0.10;
constexpr std::uint8_t kGround = 40;
constexpr std::uint8_t kDisc = 220;
constexpr int kSamples = 4;  // a pixel, along each axis

geometry::Cahv look_at(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  geometry::Cahv model;
  model.c = from;
  model.a = (to - from).normalized();
  const Eigen::Vector3d right = model.a.cross(Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Vector3d down = model.a.cross(right);
  model.h = kFocal_px * right + 0.5 * (kWidth_px - 1) * model.a;
  model.v = kFocal_px * down + 0.5 * (kHeight_px - 1) * model.a;
  return model;
}

core::Camera camera_at(double x, double y) {
  core::Camera camera;
  camera.model = look_at({x, y, 3.2}, {0.1 * x, 0.1 * y, 0.4});
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.distance_min_m = 1.5;
  camera.distance_max_m = 6.0;
  camera.intensity_min_dn = 128;
  return camera;
}

bool inside_disc(const geometry::CameraModel& model, const Eigen::Vector2d& pixel,
                 const Eigen::Vector3d& centre, const Eigen::Vector3d& normal) {
  geometry::Ray ray;
  if (geometry::unproject(model, pixel, ray) != geometry::OpticsStatus::ok) return false;
  const double along = (centre - ray.origin).dot(normal) / ray.direction.dot(normal);
  return (ray.origin + along * ray.direction - centre).norm() <= 0.5 * kDiameter_m;
}

// How much of a pixel a disc covers, 0 to 1.
double coverage(const geometry::CameraModel& model, int x, int y, const Eigen::Vector3d& centre,
                const Eigen::Vector3d& normal) {
  int inside = 0;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const Eigen::Vector2d offset((i % kSamples + 0.5) / kSamples - 0.5,
                                 (i / kSamples + 0.5) / kSamples - 0.5);
    inside += inside_disc(model, Eigen::Vector2d(x, y) + offset, centre, normal) ? 1 : 0;
  }
  return static_cast<double>(inside) / (kSamples * kSamples);
}

void draw_disc(const geometry::CameraModel& model, const Eigen::Vector3d& centre,
               const Eigen::Vector3d& normal, GreyImage& image) {
  Eigen::Vector2d at;
  if (geometry::project(model, centre, at) != geometry::OpticsStatus::ok) return;
  constexpr int kReach = 20;
  const int column = static_cast<int>(std::lround(at.x()));
  const int row = static_cast<int>(std::lround(at.y()));
  for (int y = std::max(0, row - kReach); y <= std::min(image.height_px - 1, row + kReach); ++y) {
    for (int x = std::max(0, column - kReach); x <= std::min(image.width_px - 1, column + kReach);
         ++x) {
      const double covered = coverage(model, x, y, centre, normal);
      auto& pixel = image.pixels[static_cast<std::size_t>(y * image.width_px + x)];
      pixel = static_cast<std::uint8_t>(std::lround(pixel + covered * (kDisc - pixel)));
    }
  }
}

core::Pose level_pose(double x_m, double y_m, double yaw_rad) {
  core::Pose pose;
  pose.position_m = {x_m, y_m, 0.3};
  pose.orientation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
  return pose;
}

std::string rig_text(const core::Rig& rig) {
  std::string text =
      fmt::format("[rig]\nname = \"discs\"\nframe_rate_hz = {:.1f}\n", DiscScene::kFrameRate_hz);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const std::string name = DiscScene::camera_name(i);
    text += fmt::format(
        "\n[[camera]]\nname = \"{0}\"\nmodel = \"{0}.cahv\"\ndistance_m = [1.5, 6.0]\n"
        "intensity_dn = [128, 255]\n",
        name);
  }
  return text + "\n[target]\nname = \"rover\"\ndots = \"target.csv\"\n";
}

}  // namespace

std::string GreyImage::pgm() const {
  return fmt::format("P5\n{} {}\n255\n", width_px, height_px) +
         std::string(pixels.begin(), pixels.end());
}

GreyImage flat_image(int width_px, int height_px, std::uint8_t grey) {
  const auto size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  return {width_px, height_px, std::vector<std::uint8_t>(size, grey)};
}

GreyImage noise_image(int width_px, int height_px, std::uint64_t seed) {
  GreyImage image = flat_image(width_px, height_px, 0);
  std::mt19937_64 random(seed);
  for (std::uint8_t& pixel : image.pixels) pixel = static_cast<std::uint8_t>(random());
  return image;
}

DiscScene::DiscScene() {
  for (const auto& [x, y] : {std::pair(1.4, 1.0), {1.4, -1.0}, {-1.4, 1.0}, {-1.4, -1.0}}) {
    rig_.cameras.push_back(camera_at(x, y));
  }
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.40, 0.05, 0.10),
                                   {-0.35, 0.28, 0.02},
                                   {-0.30, -0.31, 0.15},
                                   {0.05, 0.22, 0.20},
                                   {0.22, -0.20, 0.05}}) {
    rig_.target.dots.push_back({p, kDiameter_m, std::nullopt});
  }
}

GreyImage DiscScene::image(std::size_t camera, double x_m, double y_m, double yaw_rad) const {
  return image_of(camera, level_pose(x_m, y_m, yaw_rad));
}

core::Pose DiscScene::pose_at(std::uint64_t tick) {
  const auto n = static_cast<double>(tick);
  return level_pose(-0.2 + 0.01 * n, 0.1 - 0.005 * n, 0.5 + 0.02 * n);
}

GreyImage DiscScene::image_at(std::size_t camera, std::uint64_t tick) const {
  return image_of(camera, pose_at(tick));
}

GreyImage DiscScene::image_of(std::size_t camera, const core::Pose& pose) const {
  GreyImage image = flat_image(kWidth_px, kHeight_px, kGround);
  const Eigen::Vector3d normal = pose.orientation * Eigen::Vector3d::UnitZ();
  for (const core::TargetDot& dot : rig_.target.dots) {
    const Eigen::Vector3d centre = pose.orientation * dot.position_m + pose.position_m;
    draw_disc(rig_.cameras[camera].model, centre, normal, image);
  }
  return image;
}

std::string DiscScene::camera_name(std::size_t camera) {
  return fmt::format("cam{}", camera);
}

std::filesystem::path DiscScene::write_rig(const std::filesystem::path& folder) const {
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    config::CameraFile file;
    file.model = rig_.cameras[i].model;
    file.dimensions = {kWidth_px, kHeight_px};
    write_bytes(folder / (camera_name(i) + ".cahv"), config::write_camera_text(file));
  }
  std::string dots = "dot,x_m,y_m,z_m,diameter_m\n";
  for (std::size_t i = 0; i < rig_.target.dots.size(); ++i) {
    const Eigen::Vector3d& p = rig_.target.dots[i].position_m;
    dots += fmt::format("{},{},{},{},{}\n", i, p.x(), p.y(), p.z(), kDiameter_m);
  }
  write_bytes(folder / "target.csv", dots);
  write_bytes(folder / "rig.toml", rig_text(rig_));
  return folder / "rig.toml";
}

std::filesystem::path frame_path(const std::filesystem::path& folder, std::size_t camera,
                                 std::uint64_t tick) {
  return folder / DiscScene::camera_name(camera) / fmt::format("{:06}.pgm", tick);
}

void write_drive(const DiscScene& scene, const std::filesystem::path& folder, std::uint64_t ticks) {
  for (std::size_t camera = 0; camera < scene.rig().cameras.size(); ++camera) {
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      write_bytes(frame_path(folder, camera, tick), scene.image_at(camera, tick).pgm());
    }
  }
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << bytes;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace dottrack::test
