#include "app/workstation/calibrate/report/drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/workstation/svg_chart.h"
#include "app/workstation/xml_text.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using workstation::escaped;

constexpr double kPictureWidth = 460.0;
constexpr double kMapWidth = 760.0;
constexpr double kArrow = 26.0;     // length of one of nine tenths of the arrows, at most
constexpr double kLongest = 120.0;  // of any arrow
constexpr const char* kUsed = "#1f5fa8";
constexpr const char* kSuspect = "#e08a00";
constexpr const char* kLeftOut = "#c8201f";

double factor_of(const CameraCalibration& camera, double scale) {
  std::vector<double> lengths;
  for (const ResidualOfView& r : camera.residuals) {
    if (r.used) lengths.push_back(r.off_px.norm());
  }
  if (lengths.empty()) return 1.0;
  std::sort(lengths.begin(), lengths.end());
  const double typical = std::max(lengths[lengths.size() * 9 / 10], 1e-6);
  const double most = kArrow / (typical * scale);
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  const double part = most / power;
  return power * (part >= 5.0 ? 5.0 : part >= 2.0 ? 2.0 : 1.0);
}

std::string arrow(const Vector2d& from, Vector2d by, const char* colour) {
  if (by.norm() > kLongest) by *= kLongest / by.norm();
  const Vector2d to = from + by;
  std::string text = fmt::format(
      "<circle cx='{:.1f}' cy='{:.1f}' r='1.8' fill='{}'/>"
      "<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='{}' stroke-width='1.2'/>\n",
      from.x(), from.y(), colour, from.x(), from.y(), to.x(), to.y(), colour);
  return text;
}

// From fine to poor: blue, green, yellow, red.
std::string colour_of(double part) {
  constexpr std::array<std::array<double, 3>, 5> kStops{
      {{40, 70, 140}, {38, 140, 140}, {110, 190, 90}, {245, 215, 70}, {205, 50, 40}}};
  const double at = std::clamp(part, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kStops.size() - 2);
  const double rest = at - static_cast<double>(i);
  std::array<int, 3> c{};
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] = static_cast<int>(std::lround(kStops[i][k] + rest * (kStops[i + 1][k] - kStops[i][k])));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string text_at(double x, double y, const std::string& text, const char* anchor = "start") {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' font-size='12' text-anchor='{}'>{}</text>\n", x,
                     y, anchor, escaped(text));
}

class MapPicture {
 public:
  MapPicture(const ErrorMap& map, const Calibration& calibration)
      : map_(map), calibration_(calibration) {
    const double columns = static_cast<double>(map.columns);
    const double rows = static_cast<double>(map.rows);
    cell_ = std::min(kMapWidth / columns, 600.0 / rows);
    width_ = cell_ * columns;
    height_ = cell_ * rows;
    std::vector<double> seen;
    for (const double e : map.error_m) {
      if (std::isfinite(e)) seen.push_back(e);
    }
    std::sort(seen.begin(), seen.end());
    if (!seen.empty()) {
      low_ = seen.front();
      high_ = std::max(seen[(seen.size() - 1) * 95 / 100], low_ * 1.01);
    }
  }

  std::string svg() {
    const double bottom = kMargin + height_;
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{:.0f}' height='{:.0f}' "
        "font-family='sans-serif' fill='#222'>\n",
        width_ + 2 * kMargin + 120.0, height_ + 2 * kMargin);
    for (std::size_t row = 0; row < map_.rows; ++row) {
      for (std::size_t column = 0; column < map_.columns; ++column) out += cell(column, row);
    }
    out += axes(bottom) + cameras() + legend();
    return out + "</svg>\n";
  }

 private:
  static constexpr double kMargin = 50.0;

  double x(double metres) const {
    return kMargin + cell_ * (metres - map_.low_m.x()) / map_.step_m;
  }
  double y(double metres) const {
    return kMargin + height_ - cell_ * (metres - map_.low_m.y()) / map_.step_m;
  }

  std::string cell(std::size_t column, std::size_t row) const {
    const double error = map_.error_m[row * map_.columns + column];
    const std::size_t cameras = map_.cameras[row * map_.columns + column];
    const std::string title = std::isfinite(error)
                                  ? fmt::format("{}, {} cameras", length_words(error), cameras)
                                  : fmt::format("{} cameras", cameras);
    const std::string fill =
        std::isfinite(error) ? colour_of((error - low_) / (high_ - low_)) : "#dddddd";
    return fmt::format(
        "<rect x='{:.1f}' y='{:.1f}' width='{:.2f}' height='{:.2f}' fill='{}'><title>{}</title>"
        "</rect>\n",
        kMargin + cell_ * static_cast<double>(column),
        kMargin + height_ - cell_ * static_cast<double>(row + 1), cell_ + 0.3, cell_ + 0.3, fill,
        title);
  }

  std::string axes(double bottom) const {
    const double length_x = map_.step_m * static_cast<double>(map_.columns);
    const double length_y = map_.step_m * static_cast<double>(map_.rows);
    const double step = workstation::round_step(std::max(length_x, length_y), 10);
    std::string out;
    for (double v = std::ceil(map_.low_m.x() / step) * step; v <= map_.low_m.x() + length_x;
         v += step) {
      out += text_at(x(v), bottom + 18.0, fmt::format("{:.4g}", v + 0.0), "middle");
    }
    for (double v = std::ceil(map_.low_m.y() / step) * step; v <= map_.low_m.y() + length_y;
         v += step) {
      out += text_at(kMargin - 6.0, y(v) + 4.0, fmt::format("{:.4g}", v + 0.0), "end");
    }
    out += text_at(kMargin + width_ / 2.0, bottom + 38.0, "x, m", "middle");
    out += text_at(kMargin - 6.0, kMargin - 14.0, "y, m", "end");
    return out;
  }

  // Those that are far outside are not drawn.
  std::string cameras() const {
    std::string out;
    for (const CameraCalibration& c : calibration_.cameras) {
      const Eigen::Vector3d& place = geometry::centre(c.model);
      const double px = x(place.x());
      const double py = y(place.y());
      if (px < 4.0 || py < 4.0 || px > width_ + 2 * kMargin || py > height_ + 2 * kMargin) continue;
      out += fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='5' fill='white' stroke='#222' stroke-width='1.5'/>\n",
          px, py);
      out += text_at(px + 8.0, py + 4.0, c.name);
    }
    return out;
  }

  std::string legend() const {
    const double left = kMargin + width_ + 30.0;
    constexpr int kSteps = 20;
    constexpr double kStep = 10.0;
    std::string out;
    for (int i = 0; i < kSteps; ++i) {
      out += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='18' height='{:.1f}' fill='{}'/>\n",
                         left, kMargin + kStep * (kSteps - 1 - i), kStep + 0.3,
                         colour_of((i + 0.5) / kSteps));
    }
    out += text_at(left + 24.0, kMargin + kStep * kSteps, length_words(low_));
    out += text_at(left + 24.0, kMargin + 10.0, length_words(high_));
    return out;
  }

  const ErrorMap& map_;
  const Calibration& calibration_;
  double cell_ = 1.0;
  double width_ = 0.0;
  double height_ = 0.0;
  double low_ = 0.0;
  double high_ = 1.0;
};

}  // namespace

std::string residual_drawing(const CameraCalibration& camera,
                             std::span<const SuspectDot> suspects) {
  const double scale = kPictureWidth / camera.width_px;
  const double height = scale * camera.height_px;
  const double factor = factor_of(camera, scale);
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{:.0f}' height='{:.0f}' "
      "font-family='sans-serif' fill='#222'>\n<rect x='0.5' y='0.5' width='{:.0f}' height='{:.0f}' "
      "fill='#fafafa' stroke='#888'/>\n",
      kPictureWidth + 1.0, height + 24.0, kPictureWidth, height);
  if (camera.hull_px.size() > 2) {
    out += "<polygon points='";
    for (const Vector2d& p : camera.hull_px) {
      out += fmt::format("{:.1f},{:.1f} ", scale * (p.x() + 0.5), scale * (p.y() + 0.5));
    }
    out += "' fill='#e9f1ea' stroke='#9fbfa4'/>\n";
  }
  for (const ResidualOfView& r : camera.residuals) {
    const bool suspect = std::any_of(suspects.begin(), suspects.end(),
                                     [&](const SuspectDot& s) { return s.dot == r.dot; });
    const char* const colour = !r.used ? kLeftOut : suspect ? kSuspect : kUsed;
    out += arrow(scale * (r.pixel + Vector2d::Constant(0.5)), -factor * scale * r.off_px, colour);
  }
  out += text_at(2.0, height + 18.0,
                 fmt::format("{} x {} px; arrows {:g} times enlarged", camera.width_px,
                             camera.height_px, factor));
  return out + "</svg>\n";
}

std::string map_drawing(const ErrorMap& map, const Calibration& calibration) {
  if (map.columns == 0 || map.rows == 0) return "";
  return MapPicture(map, calibration).svg();
}

std::string length_words(double metres) {
  if (metres >= 1.0) return fmt::format("{:.3g} m", metres);
  if (metres >= 1e-4) return fmt::format("{:.3g} mm", 1e3 * metres);
  return fmt::format("{:.3g} um", 1e6 * metres);
}

}  // namespace dottrack::calibrate
