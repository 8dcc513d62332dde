#include "app/workstation/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/workstation/bitmap_font.h"

namespace dottrack::workstation {
namespace {

constexpr int kPieces = 48;             // of a line in space
constexpr double kForwardFactor = 2.0;  // how much longer the forward axis is

class Overlay {
 public:
  explicit Overlay(const OverlayInput& input)
      : input_(input), camera_(input.rig.cameras[input.camera]), canvas_(blank(input, camera_)) {
    const int size_px = std::max(canvas_.width_px(), canvas_.height_px());
    line_px_ = std::max(1, static_cast<int>(std::lround(size_px / 700.0)));
    text_px_ = std::max(1, static_cast<int>(std::lround(canvas_.width_px() / 640.0)));
  }

  Canvas draw() {
    draw_regions();
    if (input_.result.has_pose) {
      draw_ellipses();
      connect_dots();
      draw_axes();
    }
    draw_legend();
    return std::move(canvas_);
  }

 private:
  static Canvas blank(const OverlayInput& input, const core::Camera& camera) {
    return input.image.empty() ? Canvas(camera.width_px, camera.height_px) : Canvas(input.image);
  }

  void draw_regions() {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(1.0 + 2 * line_px_);
    for (const image::Region& region : input_.regions) {
      canvas_.box(Eigen::Vector2d(region.x_min, region.y_min) - margin,
                  Eigen::Vector2d(region.x_max, region.y_max) + margin, kOverlayColours.regions,
                  line_px_);
    }
  }

  void draw_ellipses() {
    for (const core::DotState& dot : input_.result.dots) {
      const core::DotView& view = dot.views[input_.camera];
      if (!view.used) continue;
      canvas_.ellipse(view.pixel.cast<double>(), static_cast<double>(view.semi_major_px),
                      static_cast<double>(view.semi_minor_px), static_cast<double>(view.angle_rad),
                      kOverlayColours.used, 1);
    }
  }

  // Projected piece by piece; pieces with an end that the camera cannot see are left out.
  void space_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, Colour colour) {
    Eigen::Vector2d last;
    bool has_last = false;
    for (int i = 0; i <= kPieces; ++i) {
      const Eigen::Vector3d p = from + (to - from) * (static_cast<double>(i) / kPieces);
      Eigen::Vector2d pixel;
      const bool seen = geometry::project(camera_.model, p, pixel) == geometry::OpticsStatus::ok;
      if (seen && has_last) canvas_.line(last, pixel, colour, line_px_);
      if (seen) last = pixel;
      has_last = seen;
    }
  }

  // Around the target in the order of their bearing from its middle: the lines do not cross.
  std::vector<std::size_t> dots_by_bearing() const {
    const auto& dots = input_.rig.target.dots;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const core::TargetDot& dot : dots) {
      middle += dot.position_m / static_cast<double>(dots.size());
    }
    std::vector<std::pair<double, std::size_t>> bearings;
    for (std::size_t i = 0; i < dots.size(); ++i) {
      if (!input_.result.dots[i].located) continue;
      const Eigen::Vector3d from_middle = dots[i].position_m - middle;
      bearings.emplace_back(std::atan2(from_middle.y(), from_middle.x()), i);
    }
    std::sort(bearings.begin(), bearings.end());
    std::vector<std::size_t> order;
    order.reserve(bearings.size());
    for (const auto& [bearing, dot] : bearings) order.push_back(dot);
    return order;
  }

  void connect_dots() {
    const std::vector<std::size_t> order = dots_by_bearing();
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t next = order[(i + 1) % order.size()];
      space_line(input_.result.dots[order[i]].position_m, input_.result.dots[next].position_m,
                 kOverlayColours.dots);
    }
  }

  // A third of the target's size, so that the axes can be told from the target.
  double axis_length_m() const {
    double largest_m = 0.0;
    for (const core::TargetDot& a : input_.rig.target.dots) {
      for (const core::TargetDot& b : input_.rig.target.dots) {
        largest_m = std::max(largest_m, (a.position_m - b.position_m).norm());
      }
    }
    return largest_m / 3.0;
  }

  void draw_axes() {
    const core::Pose& pose = input_.result.pose;
    const double length_m = axis_length_m();
    constexpr std::array<const char*, 3> kNames = {"X", "Y", "Z"};
    for (int axis = 0; axis < 3; ++axis) {
      const double reach_m = axis == 0 ? kForwardFactor * length_m : length_m;
      const Eigen::Vector3d tip =
          pose.position_m + reach_m * (pose.orientation * Eigen::Vector3d::Unit(axis));
      space_line(pose.position_m, tip, kOverlayColours.axes);
      name_at(tip, kNames[static_cast<std::size_t>(axis)]);
    }
  }

  void name_at(const Eigen::Vector3d& p, const char* name) {
    Eigen::Vector2d pixel;
    if (geometry::project(camera_.model, p, pixel) != geometry::OpticsStatus::ok) return;
    const bool inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < canvas_.width_px() &&
                        pixel.y() < canvas_.height_px();
    if (!inside) return;
    canvas_.text(static_cast<int>(pixel.x()) + 3 * text_px_,
                 static_cast<int>(pixel.y()) - kGlyphRows * text_px_, name, kOverlayColours.axes,
                 text_px_);
  }

  std::vector<std::string> legend() const {
    const core::TickResult& result = input_.result;
    std::string state = fmt::format("{}  tick {}  {}", input_.camera_name, result.tick,
                                    core::to_string(result.state));
    if (input_.image.empty()) state += "  no image";
    if (!result.has_pose)
      return {state, fmt::format("no pose: {}", core::to_string(result.reason))};
    const Eigen::Vector3d& p = result.pose.position_m;
    const Eigen::Quaterniond& q = result.pose.orientation;
    return {
        state, fmt::format("x {:.4f}  y {:.4f}  z {:.4f} m", p.x(), p.y(), p.z()),
        fmt::format("qx {:.4f}  qy {:.4f}  qz {:.4f}  qw {:.4f}", q.x(), q.y(), q.z(), q.w()),
        fmt::format("residual {:.3f} mm  dots {}  cameras {}", 1000.0 * result.pose.rms_residual_m,
                    result.dots_used, result.cameras_used.size())};
  }

  // What the camera was set to for a picture to come, and how bright its dots are in this one.
  static std::string light_line(const exposure::CameraLight& light) {
    return fmt::format("light {}  {:.3f} ms  gain {:.2f}  iris {:.2f} {}  peak {} dn",
                       exposure::to_string(light.state), 1e3 * to_seconds(light.setting.exposure),
                       light.setting.gain, light.opening, exposure::to_string(light.iris),
                       light.peak_dn);
  }

  void draw_legend() {
    std::vector<std::string> lines = legend();
    const bool controlled =
        input_.light != nullptr && input_.light->state != exposure::LightState::off;
    if (controlled) lines.push_back(light_line(*input_.light));
    std::size_t longest = 0;
    for (const std::string& line : lines) longest = std::max(longest, line.size());
    const int line_height = (kGlyphRows + 3) * text_px_;
    const int margin = 4 * text_px_;
    canvas_.shade(0, 0, static_cast<int>(longest) * (kGlyphColumns + 1) * text_px_ + 2 * margin,
                  static_cast<int>(lines.size()) * line_height + margin);
    int y = margin;
    for (const std::string& line : lines) {
      canvas_.text(margin, y, line, kOverlayColours.legend, text_px_);
      y += line_height;
    }
  }

  const OverlayInput& input_;
  const core::Camera& camera_;
  Canvas canvas_;
  int line_px_ = 1;
  int text_px_ = 1;
};

}  // namespace

Canvas draw_overlay(const OverlayInput& input) {
  return Overlay(input).draw();
}

}  // namespace dottrack::workstation
