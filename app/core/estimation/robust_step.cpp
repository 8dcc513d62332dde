#include "app/core/estimation/robust_step.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace dottrack::estimation {
namespace {

constexpr double kMinPivot = 1e-9;
constexpr double kMedian = 1.3863;  // of chi squared with two degrees of freedom
constexpr std::array<double, 5> kWidths = {64.0, 16.0, 4.0, 2.0, 1.0};  // times kWrongView
constexpr int kMaxTests = 4;

using Squares = StaticVector<double, kMaxCameras * core::kMaxDots>;

bool solve(const NormalEquations& normal, Vector6d& step) {
  if (!determines_pose(normal.information)) return false;
  step = normal.information.ldlt().solve(normal.gradient);
  return true;
}

Squares squares_of(std::span<const ViewRow> rows, const Vector6d& step) {
  Squares squares;
  for (const ViewRow& row : rows) squares.push_back(row.squared(step));
  return squares;
}

// How much larger the squared residuals are than their variances say; at least 1.
double excess(Squares squares) {
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>((squares.size() - 1) / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::max(1.0, *middle / kMedian);
}

bool reweighted(std::span<const ViewRow> rows, double width, Vector6d& step) {
  const Squares squares = squares_of(rows, step);
  const double scale = width * kWrongView * excess(squares);
  NormalEquations normal;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double part = scale / (scale + squares[i]);
    normal.add(rows[i], part * part);
  }
  return solve(normal, step);
}

bool plain(std::span<const ViewRow> rows, const Flags& used, Vector6d& step) {
  NormalEquations normal;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (used[i]) normal.add(rows[i], 1.0);
  }
  return solve(normal, step);
}

// Plain least squares over the views within, until those are the same.
bool settle(std::span<const ViewRow> rows, Vector6d& step, Flags& used) {
  for (int i = 0; i < kMaxTests && test_views(rows, step, used); ++i) {
    if (!plain(rows, used, step)) return false;
  }
  return true;
}

}  // namespace

void NormalEquations::add(const ViewRow& row, double weight) {
  const Vector6d along_x = row.jacobian.row(0).transpose();
  const Vector6d along_y = row.jacobian.row(1).transpose();
  const Vector6d x = weight * along_x;
  const Vector6d y = weight * along_y;
  for (int column = 0; column < 6; ++column) {
    information.col(column) += x[column] * along_x + y[column] * along_y;
  }
  gradient += x * row.residual.x() + y * row.residual.y();
}

bool test_views(std::span<const ViewRow> rows, const Vector6d& step, Flags& used) {
  if (rows.empty()) return false;
  const Squares squares = squares_of(rows, step);
  const double limit = kWrongView * excess(squares);
  bool changed = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool fits = squares[i] <= limit;
    changed = changed || fits != used[i];
    used[i] = fits;
  }
  return changed;
}

bool determines_pose(const Matrix6d& information) {
  if (!(information.diagonal().minCoeff() > 0.0)) return false;
  const Vector6d scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d unitless = scale.asDiagonal() * information * scale.asDiagonal();
  return unitless.ldlt().vectorD().minCoeff() > kMinPivot;
}

bool robust_step(std::span<const ViewRow> rows, Vector6d& step, Flags& used) {
  used.fill(false);
  step.setZero();
  if (rows.empty()) return false;
  for (const double width : kWidths) {
    if (!reweighted(rows, width, step)) return false;
  }
  return settle(rows, step, used);
}

bool repeated_step(std::span<const ViewRow> rows, Vector6d& step, Flags& used) {
  return plain(rows, used, step) && settle(rows, step, used);
}

}  // namespace dottrack::estimation
