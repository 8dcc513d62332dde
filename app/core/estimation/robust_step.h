#pragma once
// The step of the pose that most of the views agree on.

#include <array>
#include <cstddef>
#include <span>

#include "app/core/estimation/view_rows.h"

namespace dottrack::estimation {

struct NormalEquations {
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();

  // Solving looks at the information's lower triangle alone; until it is mirrored, the upper one
  // differs by roundings.
  void add(const ViewRow& row, double weight);
  void mirror() {
    information.triangularView<Eigen::StrictlyUpper>() = information.transpose().eval();
  }
  void scale(double factor) {
    information *= factor;
    gradient *= factor;
  }
};

using Flags = std::array<bool, kMaxCameras * core::kMaxDots>;

// A view is wrong, and does not count, where its two coordinates are further off than one of ten
// thousand right ones is; where most views are off by more than their variances say (a model or a
// target that is not quite as it is said to be), by as much more.
inline constexpr double kWrongView = 18.42;  // of chi squared with two degrees of freedom

// Least squares with a redescending loss (Geman and McClure's), whose width comes down to
// kWrongView; then plain least squares over the views within it, tested anew after each solution:
// left out, brought back. `used` says which rows are within. False: the rows do not determine a
// step.
bool robust_step(std::span<const ViewRow> rows, Vector6d& step, Flags& used);

// The same of the same views about a pose close by, where `used` is known already: no loss is
// needed to tell the wrong ones.
bool repeated_step(std::span<const ViewRow> rows, Vector6d& step, Flags& used);

// Which rows are within kWrongView of a step; true when that differs from what `used` said.
bool test_views(std::span<const ViewRow> rows, const Vector6d& step, Flags& used);

// All six coordinates are held: no direction of the information, its units taken out, is empty.
bool determines_pose(const Matrix6d& information);

}  // namespace dottrack::estimation
