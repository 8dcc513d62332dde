#include "tests/unit/image/painted_dot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dottrack::image::test {
namespace {

using Eigen::Vector2d;

constexpr double kRow_px = 1.0 / 32.0;  // between chords
constexpr double kReach_sigmas = 6.0;

struct Chord {
  double first;
  double last;
};

Chord cut(Chord chord, const HalfPlane& half, double y) {
  const double along = half.normal.x();
  const double rest = half.normal.y() * (y - half.through.y());
  if (std::abs(along) < 1e-12) return rest > 0.0 ? chord : Chord{0.0, -1.0};
  const double x = half.through.x() - rest / along;
  return along > 0.0 ? Chord{std::max(chord.first, x), chord.last}
                     : Chord{chord.first, std::min(chord.last, x)};
}

// Where the ellipse is on a row.
Chord chord_of(const PaintedEllipse& ellipse, double y) {
  const double c = std::cos(ellipse.angle_rad);
  const double s = std::sin(ellipse.angle_rad);
  const double m = 1.0 / (ellipse.semi_major_px * ellipse.semi_major_px);
  const double n = 1.0 / (ellipse.semi_minor_px * ellipse.semi_minor_px);
  const double a = c * c * m + s * s * n;
  const double b = c * s * (m - n);
  const double dy = y - ellipse.centre.y();
  const double root2 = a - m * n * dy * dy;
  if (root2 <= 0.0) return {0.0, -1.0};
  const double middle = ellipse.centre.x() - b * dy / a;
  return {middle - std::sqrt(root2) / a, middle + std::sqrt(root2) / a};
}

double distribution(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

}  // namespace

Canvas::Canvas(int side_px, double blur_px)
    : side_(side_px), blur_(blur_px), grey_(static_cast<std::size_t>(side_px * side_px)) {}

void Canvas::add_level(double dn) {
  for (double& grey : grey_) grey += dn;
}

void Canvas::add_slope(const Vector2d& dn_per_px) {
  const double middle = 0.5 * (side_ - 1);
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      grey_[index(x, y)] += dn_per_px.dot(Vector2d(x - middle, y - middle));
    }
  }
}

// How much of a point's light a pixel t away takes, along one axis.
double Canvas::spread(double t) const {
  return distribution((t + 0.5) / blur_) - distribution((t - 0.5) / blur_);
}

// The integral of that up to t.
double Canvas::spread_integral(double t) const {
  if (t > 0.5 + kReach_sigmas * blur_) return 1.0;
  if (t < -0.5 - kReach_sigmas * blur_) return 0.0;
  const auto up_to = [this](double v) {
    return v * distribution(v / blur_) + blur_ * density(v / blur_);
  };
  return up_to(t + 0.5) - up_to(t - 0.5);
}

void Canvas::paint_chord(double y, double height_px, double first, double last, double dn) {
  const double reach = 0.5 + kReach_sigmas * blur_;
  const int x_first = std::max(static_cast<int>(std::floor(first - reach)), 0);
  const int x_last = std::min(static_cast<int>(std::ceil(last + reach)), side_ - 1);
  const int y_first = std::max(static_cast<int>(std::floor(y - reach)), 0);
  const int y_last = std::min(static_cast<int>(std::ceil(y + reach)), side_ - 1);
  if (x_first > x_last) return;
  std::vector<double> down;
  for (int j = y_first; j <= y_last; ++j) down.push_back(spread(j - y) * height_px * dn);
  // Where the chord covers all that a pixel takes light from, the light is the same: only where
  // that begins and ends is noted, and add_runs adds it.
  const int run_first = std::clamp(static_cast<int>(std::ceil(first + reach)), x_first, x_last + 1);
  const int run_last =
      std::max(std::min(static_cast<int>(std::floor(last - reach)), x_last), run_first - 1);
  for (int j = y_first; j <= y_last; ++j) {
    const double dn_here = down[static_cast<std::size_t>(j - y_first)];
    runs_[run_index(run_first, j)] += dn_here;
    runs_[run_index(run_last + 1, j)] -= dn_here;
  }
  for (int x = x_first; x <= x_last; ++x) {
    if (x == run_first && run_last >= run_first) x = run_last + 1;
    if (x > x_last) break;
    const double light = spread_integral(x - first) - spread_integral(x - last);
    for (int j = y_first; j <= y_last; ++j) {
      grey_[index(x, j)] += light * down[static_cast<std::size_t>(j - y_first)];
    }
  }
}

void Canvas::add_runs() {
  for (int y = 0; y < side_; ++y) {
    double sum = 0.0;
    for (int x = 0; x < side_; ++x) {
      sum += runs_[run_index(x, y)];
      grey_[index(x, y)] += sum;
    }
  }
}

void Canvas::paint(const PaintedEllipse* ellipse, const std::vector<HalfPlane>& within, double dn) {
  const double margin = 10.0;
  double top = -margin;
  double bottom = side_ + margin;
  if (ellipse != nullptr) {
    top = ellipse->centre.y() - ellipse->semi_major_px;
    bottom = ellipse->centre.y() + ellipse->semi_major_px;
  }
  runs_.assign(static_cast<std::size_t>((side_ + 1) * side_), 0.0);
  const int rows = static_cast<int>(std::ceil((bottom - top) / kRow_px));
  const double height = (bottom - top) / rows;
  for (int i = 0; i < rows; ++i) {
    const double y = top + (i + 0.5) * height;
    Chord chord{-margin, side_ + margin};
    if (ellipse != nullptr) chord = chord_of(*ellipse, y);
    for (const HalfPlane& half : within) chord = cut(chord, half, y);
    if (chord.first < chord.last) paint_chord(y, height, chord.first, chord.last, dn);
  }
  add_runs();
}

void Canvas::bloom(double full_well_dn) {
  for (int x = 0; x < side_; ++x) {
    std::vector<double> excess;
    for (int y = 0; y < side_; ++y) {
      double& grey = grey_[index(x, y)];
      excess.push_back(std::max(grey - full_well_dn, 0.0));
      grey = std::min(grey, full_well_dn);
    }
    const auto spill = [&](int from, int step, double share) {
      double spilt = 0.0;
      for (int y = from; y >= 0 && y < side_; y += step) {
        double& grey = grey_[index(x, y)];
        const double taken = std::min(spilt, full_well_dn - grey);
        grey += taken;
        spilt += share * excess[static_cast<std::size_t>(y)] - taken;
      }
    };
    spill(0, 1, 0.75);
    spill(side_ - 1, -1, 0.25);
  }
}

Picture Canvas::expose(const Noise& noise, Random& random) const {
  std::normal_distribution<double> normal(0.0, 1.0);
  Picture picture(side_, side_);
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      const double grey = at(x, y);
      const double variance = noise.read_dn * noise.read_dn + noise.per_dn * std::max(grey, 0.0);
      const double seen = grey + std::sqrt(variance) * normal(random);
      picture.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(seen), 0L, 255L));
    }
  }
  return picture;
}

}  // namespace dottrack::image::test
