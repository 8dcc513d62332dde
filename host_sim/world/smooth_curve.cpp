#include "host_sim/world/smooth_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kSteps = 32;  // in a piece
constexpr double kStep = 1.0 / static_cast<double>(kSteps);

double knot_spacing(const Vector2d& a, const Vector2d& b) {
  return std::sqrt((b - a).norm());
}

// Velocity at b of the Catmull-Rom curve over the knots of a, b, c.
Vector2d velocity(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double before = knot_spacing(a, b);
  const double after = knot_spacing(b, c);
  return (b - a) / before - (c - a) / (before + after) + (c - b) / after;
}

}  // namespace

Vector2d SmoothCurve::Piece::position(double u) const {
  const double v = 1.0 - u;
  return v * v * ((1.0 + 2.0 * u) * from + u * from_slope) +
         u * u * ((1.0 + 2.0 * v) * to - v * to_slope);
}

Vector2d SmoothCurve::Piece::slope(double u) const {
  const double v = 1.0 - u;
  return 6.0 * u * v * (to - from) + v * (v - 2.0 * u) * from_slope + u * (u - 2.0 * v) * to_slope;
}

// Gauss-Legendre with five points.
double SmoothCurve::Piece::length_m(double from_u, double to_u) const {
  constexpr std::array<double, 3> kNode{0.0, 0.538469310105683, 0.906179845938664};
  constexpr std::array<double, 3> kWeight{0.568888888888889, 0.478628670499366, 0.236926885056189};
  const double middle = 0.5 * (from_u + to_u);
  const double half = 0.5 * (to_u - from_u);
  double sum = kWeight[0] * slope(middle).norm();
  for (std::size_t i = 1; i < kNode.size(); ++i) {
    const double off = half * kNode[i];
    sum += kWeight[i] * (slope(middle - off).norm() + slope(middle + off).norm());
  }
  return half * sum;
}

SmoothCurve::SmoothCurve(const std::vector<Vector2d>& points, bool closed) : closed_(closed) {
  const std::size_t n = points.size();
  const auto point = [&](std::ptrdiff_t i) -> Vector2d {
    const auto last = static_cast<std::ptrdiff_t>(n) - 1;
    if (closed) return points[static_cast<std::size_t>((i + last + 1) % (last + 1))];
    if (i < 0) return 2.0 * points[0] - points[1];
    if (i > last) return 2.0 * points[n - 1] - points[n - 2];
    return points[static_cast<std::size_t>(i)];
  };
  const auto count = static_cast<std::ptrdiff_t>(closed ? n : n - 1);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double span = knot_spacing(point(i), point(i + 1));
    pieces_.push_back({point(i), point(i + 1),
                       span * velocity(point(i - 1), point(i), point(i + 1)),
                       span * velocity(point(i), point(i + 1), point(i + 2))});
  }
  along_m_.push_back(0.0);
  for (const Piece& piece : pieces_) {
    for (std::size_t i = 0; i < kSteps; ++i) {
      const double u = kStep * static_cast<double>(i);
      along_m_.push_back(along_m_.back() + piece.length_m(u, u + kStep));
    }
  }
}

SmoothCurve::Place SmoothCurve::at(double along_m) const {
  double along = along_m;
  if (closed_) {
    along -= length_m() * std::floor(along / length_m());
  } else {
    along = std::clamp(along, 0.0, length_m());
  }
  const auto next = std::upper_bound(along_m_.begin() + 1, along_m_.end() - 1, along);
  const auto step = static_cast<std::size_t>(next - along_m_.begin()) - 1;
  const Piece& piece = pieces_[step / kSteps];
  const double from_u = kStep * static_cast<double>(step % kSteps);
  const double wanted = along - along_m_[step];
  double u = from_u + kStep * wanted / (along_m_[step + 1] - along_m_[step]);
  for (int i = 0; i < 3; ++i) {
    u -= (piece.length_m(from_u, u) - wanted) / piece.slope(u).norm();
  }
  return {piece.position(u), piece.slope(u).normalized()};
}

double SmoothCurve::distance_m(const Vector2d& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_) {
    Vector2d from = piece.from;
    for (std::size_t i = 1; i <= kSteps; ++i) {
      const Vector2d to = piece.position(kStep * static_cast<double>(i));
      const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - from - t * (to - from)).norm());
      from = to;
    }
  }
  return least;
}

}  // namespace dottrack::host_sim
