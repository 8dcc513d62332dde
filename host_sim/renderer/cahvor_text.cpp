#include "host_sim/renderer/cahvor_text.h"

#include <fmt/format.h>

namespace dottrack::host_sim {
namespace {

std::string line(const char* key, const Eigen::Vector3d& v) {
  return fmt::format("{} = {:.17g} {:.17g} {:.17g}\n", key, v.x(), v.y(), v.z());
}

}  // namespace

std::string cahvor_text(const SimCamera& camera, const std::string& comment) {
  const Lens& lens = camera.lens();
  const Eigen::Matrix3d& axes = camera.rotation();
  const Eigen::Vector3d x = axes.row(0);
  const Eigen::Vector3d y = axes.row(1);
  const Eigen::Vector3d z = axes.row(2);
  const Eigen::Vector3d radial(lens.radial[0], lens.radial[1], lens.radial[2]);
  std::string text = fmt::format("# {}\n\nModel = CAHVOR = perspective, distortion\n\n", comment);
  text += fmt::format("Dimensions = {} {}\n\n", camera.width_px(), camera.height_px());
  text += line("C", camera.centre_m());
  text += line("A", z);
  text += line("H", lens.focal_x_px * x + lens.skew_px * y + lens.centre_x_px * z);
  text += line("V", lens.focal_y_px * y + lens.centre_y_px * z);
  text += line("O", axes.transpose() * lens.axis);
  text += line("R", radial);
  return text;
}

}  // namespace dottrack::host_sim
