#include "app/workstation/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/workstation/xml_text.h"

namespace dottrack::workstation {
namespace {

using Eigen::Vector2d;

constexpr double kWidth_px = 860.0;  // of the axes
constexpr double kLeft_px = 70.0;
constexpr double kRight_px = 20.0;
constexpr double kTop_px = 46.0;
constexpr double kBottom_px = 52.0;
constexpr double kRounding = 1e-9;  // of numbers of steps

struct Range {
  double low = 0.0;
  double high = 1.0;

  double size() const { return high - low; }
};

// Of all finite points along one axis; [0, 1] without any.
Range range_of(const Chart& chart, int axis) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Range range{kInfinity, -kInfinity};
  for (const Series& series : chart.series) {
    for (const Vector2d& p : series.points) {
      if (!p.allFinite()) continue;
      range.low = std::min(range.low, p[axis]);
      range.high = std::max(range.high, p[axis]);
    }
  }
  if (range.low > range.high) return {};
  if (axis == 1 && chart.y_from_zero) range.low = std::min(range.low, 0.0);
  if (range.size() <= 0.0) return {range.low - 0.5, range.high + 0.5};
  const double margin = (axis == 1 ? 0.06 : chart.equal_scales ? 0.03 : 0.0) * range.size();
  const bool at_zero = axis == 1 && chart.y_from_zero && range.low == 0.0;
  return {range.low - (at_zero ? 0.0 : margin), range.high + margin};
}

class Plot {
 public:
  Plot(const Chart& chart, double top_px)
      : chart_(chart), top_px_(top_px), x_(range_of(chart, 0)), y_(range_of(chart, 1)) {
    height_px_ = chart.equal_scales ? kWidth_px * y_.size() / x_.size() : chart.height_px;
  }

  double whole_height_px() const { return kTop_px + height_px_ + kBottom_px; }

  std::string text() {
    label(kLeft_px, top_px_ + 18.0, "start", "15", chart_.title);
    legend();
    grid(x_, true);
    grid(y_, false);
    out_ += fmt::format(
        "<rect x='{}' y='{:.1f}' width='{}' height='{:.1f}' fill='none' stroke='#888'/>\n",
        kLeft_px, top_px_ + kTop_px, kWidth_px, height_px_);
    for (const Series& series : chart_.series) draw(series);
    label(kLeft_px + kWidth_px / 2.0, top_px_ + kTop_px + height_px_ + 38.0, "middle", "12",
          chart_.x_label);
    label(kLeft_px, top_px_ + kTop_px - 8.0, "start", "12", chart_.y_label);
    return out_;
  }

 private:
  double x_px(double x) const { return kLeft_px + kWidth_px * (x - x_.low) / x_.size(); }
  double y_px(double y) const { return top_px_ + kTop_px + height_px_ * (y_.high - y) / y_.size(); }

  void label(double x, double y, const char* anchor, const char* size, const std::string& text) {
    out_ += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}' font-size='{}'>{}</text>\n",
                        x, y, anchor, size, escaped(text));
  }

  void legend() {
    double x = kLeft_px + kWidth_px;
    for (auto series = chart_.series.rbegin(); series != chart_.series.rend(); ++series) {
      if (series->label.empty()) continue;
      label(x, top_px_ + 18.0, "end", "12", series->label);
      x -= 7.0 * static_cast<double>(series->label.size()) + 18.0;
      out_ += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='10' height='10' fill='{}'/>\n", x,
                          top_px_ + 9.0, series->colour);
      x -= 14.0;
    }
  }

  void grid(const Range& range, bool along_x) {
    const double step = round_step(range.size(), along_x ? 11 : 6);
    const long first = std::lround(std::ceil(range.low / step - kRounding));
    const long last = std::lround(std::floor(range.high / step + kRounding));
    for (long i = first; i <= last; ++i) {
      const double value = static_cast<double>(i) * step;
      const double x0 = along_x ? x_px(value) : kLeft_px;
      const double x1 = along_x ? x0 : kLeft_px + kWidth_px;
      const double y0 = along_x ? top_px_ + kTop_px : y_px(value);
      const double y1 = along_x ? y0 + height_px_ : y0;
      out_ +=
          fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='#e4e4e4'/>\n",
                      x0, y0, x1, y1);
      const std::string number = fmt::format("{:.6g}", value);
      if (along_x) {
        label(x0, y1 + 16.0, "middle", "11", number);
      } else {
        label(kLeft_px - 6.0, y0 + 4.0, "end", "11", number);
      }
    }
  }

  void draw(const Series& series) {
    switch (series.style) {
      case Style::line:
        return polyline(series, false);
      case Style::steps:
        return polyline(series, true);
      case Style::points:
        return points(series);
      case Style::bars:
        return bars(series);
    }
  }

  void polyline(const Series& series, bool steps) {
    std::string path;
    bool pen_down = false;
    for (const Vector2d& p : series.points) {
      if (!p.allFinite()) {
        pen_down = false;
        continue;
      }
      if (pen_down && steps) path += fmt::format("H{:.1f}", x_px(p.x()));
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', x_px(p.x()), y_px(p.y()));
      pen_down = true;
    }
    out_ += fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.5'/>\n", path,
                        series.colour);
  }

  void points(const Series& series) {
    for (const Vector2d& p : series.points) {
      if (!p.allFinite()) continue;
      out_ += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.5' fill='{}'/>\n", x_px(p.x()),
                          y_px(p.y()), series.colour);
    }
  }

  void bars(const Series& series) {
    for (std::size_t i = 0; i + 1 < series.points.size(); ++i) {
      const Vector2d& p = series.points[i];
      const double width = x_px(series.points[i + 1].x()) - x_px(p.x());
      out_ += fmt::format(
          "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>\n", x_px(p.x()),
          y_px(p.y()), std::max(width - 1.0, 0.5), y_px(0.0) - y_px(p.y()), series.colour);
    }
  }

  const Chart& chart_;
  double top_px_;
  Range x_;
  Range y_;
  double height_px_;
  std::string out_;
};

}  // namespace

double round_step(double range, int most) {
  const double rough = range / most;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - kRounding)) return factor * power;
  }
  return 10.0 * power;
}

std::string svg(std::span<const Chart> charts) {
  std::string body;
  double top_px = 0.0;
  for (const Chart& chart : charts) {
    Plot plot(chart, top_px);
    body += plot.text();
    top_px += plot.whole_height_px();
  }
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 "
      "{0:.0f} {1:.0f}' font-family='sans-serif' fill='#222'>\n<rect width='100%' height='100%' "
      "fill='white'/>\n{2}</svg>\n",
      kLeft_px + kWidth_px + kRight_px, top_px, body);
}

}  // namespace dottrack::workstation
