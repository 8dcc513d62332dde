#include "host_sim/renderer/camera_text.h"

#include <fmt/format.h>

#include <array>

namespace dottrack::host_sim {
namespace {

std::string line(const char* key, const Eigen::Vector3d& v) {
  return fmt::format("{} = {:.17g} {:.17g} {:.17g}\n", key, v.x(), v.y(), v.z());
}

Eigen::Vector3d vector(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

// What JPL calls the model.
std::string name_of(const Lens& lens) {
  if (lens.kind == LensKind::pinhole) return "CAHV = perspective, linear";
  if (lens.kind == LensKind::radial) return "CAHVOR = perspective, distortion";
  if (lens.linearity == 0.0) return "CAHVORE2 = fish-eye";
  return fmt::format("CAHVORE3,{:.17g} = general", lens.linearity);
}

}  // namespace

std::string camera_text(const SimCamera& camera, const std::string& comment) {
  const Lens& lens = camera.lens();
  const Eigen::Matrix3d& axes = camera.rotation();
  const Eigen::Vector3d x = axes.row(0);
  const Eigen::Vector3d y = axes.row(1);
  const Eigen::Vector3d z = axes.row(2);
  std::string text = fmt::format("# {}\n\nModel = {}\n\n", comment, name_of(lens));
  text += fmt::format("Dimensions = {} {}\n\n", camera.width_px(), camera.height_px());
  text += line("C", camera.centre_m());
  text += line("A", z);
  text += line("H", lens.focal_x_px * x + lens.skew_px * y + lens.centre_x_px * z);
  text += line("V", lens.focal_y_px * y + lens.centre_y_px * z);
  if (lens.kind == LensKind::pinhole) return text;
  text += line("O", axes.transpose() * lens.axis);
  text += line("R", vector(lens.radial));
  if (lens.kind == LensKind::fisheye) text += line("E", vector(lens.pupil_m));
  return text;
}

}  // namespace dottrack::host_sim
