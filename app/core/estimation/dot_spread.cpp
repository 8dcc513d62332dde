#include "app/core/estimation/dot_spread.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace dottrack::estimation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36d = Eigen::Matrix<double, 3, 6>;
using Matrix63d = Eigen::Matrix<double, 6, 3>;
using Matrix32d = Eigen::Matrix<double, 3, 2>;

constexpr double kKept = 0.9;        // a tick
constexpr double kRounding = 1e-10;  // of a sum of squares: less is nothing

// Of one dot's rows: what its place, and its place together with the pose, do to them.
struct DotSums {
  Vector3d pull = Vector3d::Zero();
  Matrix3d information = Matrix3d::Zero();
  Matrix63d with_pose = Matrix63d::Zero();

  void add(const ViewRow& row) {
    const Matrix32d by_place = row.by_place.transpose();
    pull.noalias() += by_place * row.residual;
    information.noalias() += by_place * row.by_place;
    with_pose.noalias() += row.jacobian.transpose() * row.by_place;
  }
};

// With B what the dots' places do to the rows, J what the pose does, N its information, the
// residuals of the best pose are P r, P = 1 - J N^-1 J^T. The mean of |B^T P r|^2 is
//   trace B^T P C P B,  C = 1 + sum over dots, cameras (together - own),
// where `together` is what the error of a place or model does to all rows, and `own` as much of it
// as whitening has put into each row by itself.
class Moments {
 public:
  Moments(std::span<const ViewRow> rows, const Flags& used, const Matrix6d& information)
      : rows_(rows), used_(used), inverse_(information.inverse()) {
    for_each_row([&](const ViewRow& row) { dots_[row.dot].add(row); });
    Matrix6d common = Matrix6d::Zero();
    for (const DotSums& dot : dots_) common.noalias() += dot.with_pose * dot.with_pose.transpose();
    through_pose_.noalias() = inverse_ * common * inverse_;
    double of_squares = 0.0;
    double taken_by_pose = -through_pose_.cwiseProduct(common).sum();
    for (const DotSums& dot : dots_) {
      squared_pull_ += dot.pull.squaredNorm();
      trace_ += dot.information.trace();
      of_squares += dot.information.squaredNorm();
      taken_by_pose += 2.0 * shared(dot.information, dot.with_pose.transpose(), dot);
    }
    trace_ -= inverse_.cwiseProduct(common).sum();
    const double left = of_squares - taken_by_pose;
    if (left > kRounding * of_squares) information_ = std::sqrt(left);
  }

  // |B^T P r|^2 beyond what independent rows of unit variance would show.
  double excess() const { return squared_pull_ - trace_; }

  // Root of the trace of (B^T P B)^2; nothing where the pose takes all that the views say.
  double information() const { return information_; }

  // Of each row's own part of the dots' variance, per square metre.
  double own_part() const {
    double sum = 0.0;
    for_each_row([&](const ViewRow& row) {
      const Matrix32d by_place = row.by_place.transpose();
      const Matrix3d own = by_place * row.by_place;
      const Matrix36d with_pose = by_place * row.jacobian;
      sum += own.squaredNorm() - 2.0 * shared(own, with_pose, dots_[row.dot]) +
             (with_pose * through_pose_).cwiseProduct(with_pose).sum();
    });
    return sum;
  }

  // Of the cameras' models: together without own. What |B^T e|^2 is cancels out of it, as a camera
  // sees a dot once.
  double model_part() const {
    double own = 0.0;
    std::array<ModelPulls, kMaxCameras> by_model;
    for_each_row([&](const ViewRow& row) {
      by_model[row.camera].resize(row.model_errors.size());
      for (std::size_t i = 0; i < row.model_errors.size(); ++i) {
        const Vector3d on_dot = row.by_place.transpose() * row.model_errors[i];
        const ModelPull pull{row.jacobian.transpose() * row.model_errors[i],
                             dots_[row.dot].with_pose * on_dot};
        own += part_of(pull);
        by_model[row.camera][i].add(pull);
      }
    });
    double together = 0.0;
    for (const ModelPulls& camera : by_model) {
      for (const ModelPull& pull : camera) together += part_of(pull);
    }
    return together - own;
  }

 private:
  // What a model's error does to the pose, and to the dots as the pose feels it.
  struct ModelPull {
    Vector6d on_pose = Vector6d::Zero();
    Vector6d on_dots = Vector6d::Zero();

    void add(const ModelPull& other) {
      on_pose += other.on_pose;
      on_dots += other.on_dots;
    }
  };
  using ModelPulls = StaticVector<ModelPull, core::kMaxModelErrors>;

  template <class Visit>
  void for_each_row(Visit visit) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (used_[i]) visit(rows_[i]);
    }
  }
  double shared(const Matrix3d& own, const Matrix36d& with_pose, const DotSums& dot) const {
    return (own * (with_pose * inverse_)).cwiseProduct(dot.with_pose.transpose()).sum();
  }
  double part_of(const ModelPull& pull) const {
    return pull.on_pose.dot(through_pose_ * pull.on_pose) -
           2.0 * pull.on_dots.dot(inverse_ * pull.on_pose);
  }

  std::span<const ViewRow> rows_;
  const Flags& used_;
  Matrix6d inverse_;
  Matrix6d through_pose_;
  std::array<DotSums, core::kMaxDots> dots_;
  double squared_pull_ = 0.0;
  double trace_ = 0.0;
  double information_ = 0.0;
};

SpreadEvidence later(const SpreadEvidence& taken, const SpreadEvidence& evidence) {
  return {kKept * taken.sum + evidence.sum, kKept * taken.weight + evidence.weight};
}

}  // namespace

SpreadEvidence spread_evidence(std::span<const ViewRow> rows, const Flags& used,
                               const Matrix6d& information, double assumed_m2) {
  const Moments moments(rows, used, information);
  const double weight = moments.information();
  if (!(weight > 0.0)) return {};
  const double excess = moments.excess() + assumed_m2 * moments.own_part() - moments.model_part();
  if (!std::isfinite(excess) || !std::isfinite(weight)) return {};
  return {excess / weight, weight};
}

double DotSpread::variance_m2() const {
  return std::max(taken_.variance_m2(), 0.0);
}

double DotSpread::variance_with(const SpreadEvidence& evidence) const {
  return std::max(later(taken_, evidence).variance_m2(), 0.0);
}

void DotSpread::take_in(const SpreadEvidence& evidence) {
  taken_ = later(taken_, evidence);
}

}  // namespace dottrack::estimation
