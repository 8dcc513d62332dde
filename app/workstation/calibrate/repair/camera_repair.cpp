#include "app/workstation/calibrate/repair/camera_repair.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/workstation/calibrate/repair/model_vectors.h"
#include "app/workstation/survey/disc_image.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using geometry::CameraModel;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

constexpr int kRounds = 30;
constexpr double kEnough = 1e-10;        // metres and radians
constexpr double kHuber = 2.5;           // standard deviations; beyond, a view counts less
constexpr double kLeastSigma_px = 1e-2;  // no dot is measured better
constexpr std::size_t kFewestTicks = 10;
constexpr std::size_t kFewestViews = 30;
// In some direction the views leave this part or more of what was known beforehand: they do not
// determine the pose.
constexpr double kMostLeftOpen = 0.97;
// Neighbours in time share what is odd about their pictures, and the error of the poses.
constexpr std::size_t kTicksTogether = 10;
// What a knock does, standard deviations: views in a small part of a picture hardly tell a turn
// from a shift.
constexpr double kKnockTurn_rad = 0.035;
constexpr double kKnockShift_m = 0.01;

struct View {
  Vector3d point_m;
  Vector2d pixel;  // of the projection of the dot's middle
  std::size_t group;
};

struct Linear {
  Vector2d residual = Vector2d::Zero();
  Matrix26d by_pose = Matrix26d::Zero();  // turn, then shift, both in the world
  double weight = 0.0;

  // What turns residuals into scores.
  Eigen::Matrix<double, 6, 2> pull() const {
    Eigen::Matrix<double, 6, 2> result = by_pose.transpose();
    result *= weight;
    return result;
  }
};

class Fit {
 public:
  Fit(CameraModel start, std::vector<View> views)
      : start_(std::move(start)), model_(start_), views_(std::move(views)) {}

  bool run() {
    double damping = 1e-3;
    sigma_px_ = robust_sigma();
    for (int round = 0; round < kRounds; ++round) {
      Matrix6d information;
      Vector6d score;
      const double cost = normal_equations(information, score);
      const CameraModel before = model_;
      Matrix6d damped = information;
      damped.diagonal() *= 1.0 + damping;
      const Vector6d step = damped.ldlt().solve(score);
      model_ = carried(model_, step.head<3>(), step.tail<3>());
      Matrix6d next_information;
      Vector6d next_score;
      if (!(normal_equations(next_information, next_score) <= cost)) {
        model_ = before;
        damping *= 10.0;
        if (damping > 1e8) return false;
        continue;
      }
      damping = std::max(0.1 * damping, 1e-12);
      sigma_px_ = robust_sigma();
      if (step.cwiseAbs().maxCoeff() < kEnough) return true;
    }
    return true;
  }

  const CameraModel& model() const { return model_; }

  // Of turn and shift: by how the scores scatter in groups of ticks, and never less than white
  // noise of the residuals' size would make it.
  Matrix6d pose_covariance() const {
    Matrix6d information = prior_information().asDiagonal();
    Matrix6d scatter = Matrix6d::Zero();
    Vector6d group = Vector6d::Zero();
    double weighted2 = 0.0;
    double freedom = -6.0;
    double groups = 0.0;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const Linear at = linearise(views_[i]);
      information += at.pull() * at.by_pose;
      group += at.pull() * at.residual;
      weighted2 += at.weight * at.residual.squaredNorm();
      freedom += 2.0 * at.weight;
      if (i + 1 < views_.size() && views_[i + 1].group == views_[i].group) continue;
      scatter += group * group.transpose();
      group.setZero();
      groups += 1.0;
    }
    const double white =
        std::max(weighted2 / std::max(freedom, 1.0), kLeastSigma_px * kLeastSigma_px);
    const Matrix6d inverse = information.inverse();
    const Matrix6d robust = groups / std::max(groups - 1.0, 1.0) * inverse * scatter * inverse;
    // In units of white noise's variances, so that metres and radians compare.
    const double ratio = (information * robust).trace() / (6.0 * white);
    information.diagonal() -= prior_information();
    Matrix6d known = information / (std::max(ratio, 1.0) * white);
    known.diagonal().head<3>().array() += 1.0 / (kKnockTurn_rad * kKnockTurn_rad);
    known.diagonal().tail<3>().array() += 1.0 / (kKnockShift_m * kKnockShift_m);
    return known.inverse();
  }

  // Of all the model's numbers. Those of the lens are what they were, and what they are off by has
  // turned the pose along.
  MatrixXd covariance(const Matrix6d& of_pose, const std::optional<MatrixXd>& before) const {
    const MatrixXd by_pose = vectors_by_pose(model_);
    MatrixXd result = by_pose * of_pose * by_pose.transpose();
    if (!before || before->rows() != by_pose.rows()) return result;
    Matrix6d information = prior_information().asDiagonal();
    MatrixXd cross = MatrixXd::Zero(6, by_pose.rows());
    for (const View& view : views_) {
      const Linear at = linearise(view);
      information += at.pull() * at.by_pose;
      cross += at.pull() * pixel_by_vectors(model_, view.point_m);
    }
    const MatrixXd turned = turned_along(*before);
    const MatrixXd kept = MatrixXd::Identity(by_pose.rows(), by_pose.rows()) -
                          by_pose * information.ldlt().solve(cross);
    return result + kept * turned * kept.transpose();
  }

  double rms_px(const CameraModel& model) const {
    double sum2 = 0.0;
    double weights = 0.0;
    for (const View& view : views_) {
      const Linear at = linearise(view);
      Vector2d pixel;
      if (geometry::project(model, view.point_m, pixel) != geometry::OpticsStatus::ok) continue;
      sum2 += at.weight * (view.pixel - pixel).squaredNorm();
      weights += 2.0 * at.weight;
    }
    return std::sqrt(sum2 / std::max(weights, 1e-12));
  }

  std::size_t odd_views() const {
    return static_cast<std::size_t>(std::count_if(
        views_.begin(), views_.end(), [&](const View& v) { return linearise(v).weight < 0.5; }));
  }

 private:
  Linear linearise(const View& view) const {
    Linear at;
    Vector2d pixel;
    geometry::ProjectionJacobian j;
    if (geometry::project(model_, view.point_m, pixel, &j) != geometry::OpticsStatus::ok) return at;
    at.residual = view.pixel - pixel;
    const Vector3d lever = view.point_m - geometry::centre(model_);
    for (int row = 0; row < 2; ++row) {
      const Vector3d along = j.row(row).transpose();
      // To turn the camera is to turn the point back about it.
      at.by_pose.row(row).head<3>() = -lever.cross(along).transpose();
    }
    at.by_pose.rightCols<3>() = -j;
    const double off = at.residual.norm() / (sigma_px_ * std::sqrt(2.0));
    at.weight = off > kHuber ? kHuber / off : 1.0;
    return at;
  }

  // Huber's cost; the equations: information * step = score.
  double normal_equations(Matrix6d& information, Vector6d& score) const {
    information.setZero();
    const Vector6d prior = prior_information();
    const Vector6d knock = knock_so_far();
    information.diagonal() = prior;
    score = -prior.cwiseProduct(knock);
    double cost = prior.dot(knock.cwiseAbs2()) / (2.0 * sigma_px_ * sigma_px_);
    for (const View& view : views_) {
      const Linear at = linearise(view);
      information += at.pull() * at.by_pose;
      score += at.pull() * at.residual;
      const double unit = sigma_px_ * std::sqrt(2.0);
      const double off = at.residual.norm() / unit;
      cost += off > kHuber ? kHuber * (2.0 * off - kHuber) : off * off;
    }
    return cost;
  }

  // In units of a view's coordinate; of the views' as many count as there are independent ones.
  Vector6d prior_information() const {
    const double variance = sigma_px_ * sigma_px_ * static_cast<double>(kTicksTogether);
    Vector6d information;
    information.head<3>().setConstant(variance / (kKnockTurn_rad * kKnockTurn_rad));
    information.tail<3>().setConstant(variance / (kKnockShift_m * kKnockShift_m));
    return information;
  }

  Vector6d knock_so_far() const {
    const Eigen::AngleAxisd turn(rotation_between(start_, model_));
    Vector6d knock;
    knock << turn.angle() * turn.axis(), geometry::centre(model_) - geometry::centre(start_);
    return knock;
  }

  double robust_sigma() const {
    std::vector<double> all;
    for (const View& view : views_) all.push_back(linearise(view).residual.norm());
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    constexpr double kMedianOfRayleigh = 1.1774;
    return std::max(*middle / kMedianOfRayleigh, kLeastSigma_px);
  }

  // The old covariance in the axes that the camera has now.
  MatrixXd turned_along(const MatrixXd& before) const {
    const Matrix3d turn = rotation_between(start_, model_);
    MatrixXd along = MatrixXd::Identity(before.rows(), before.cols());
    for (int i = 0; i < parts(model_); ++i) {
      if (is_direction(i)) along.block<3, 3>(3 * i, 3 * i) = turn;
    }
    return along * before * along.transpose();
  }

 public:
  static Matrix3d rotation_between(const CameraModel& from, const CameraModel& to) {
    const auto axes = [](const CameraModel& model) {
      Matrix3d m;
      m.col(2) = part(model, 1).normalized();
      m.col(0) = (part(model, 2) - part(model, 2).dot(m.col(2)) * m.col(2)).normalized();
      m.col(1) = m.col(2).cross(m.col(0));
      return m;
    };
    return axes(to) * axes(from).transpose();
  }

 private:
  CameraModel start_;
  CameraModel model_;
  std::vector<View> views_;
  double sigma_px_ = 1.0;
};

// The most that is left of a knock's variance in any direction.
double left_open(const Matrix6d& of_pose) {
  Vector6d scale;
  scale << Vector3d::Constant(1.0 / kKnockTurn_rad), Vector3d::Constant(1.0 / kKnockShift_m);
  const Matrix6d part = scale.asDiagonal() * of_pose * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(part).eigenvalues().maxCoeff();
}

struct Gathered {
  std::vector<View> views;
  std::size_t ticks = 0;
};

Gathered gather(const core::Rig& rig, std::size_t camera,
                std::span<const workstation::RecordedTick> ticks) {
  Gathered gathered;
  const CameraModel& model = rig.cameras[camera].model;
  for (const workstation::RecordedTick& tick : ticks) {
    bool any = false;
    for (const workstation::RecordedView& view : tick.views) {
      if (view.camera != camera || !view.moved) continue;
      const core::TargetDot& dot = rig.target.dots[view.dot];
      gathered.views.push_back({tick.pose.orientation * dot.position_m + tick.pose.position_m,
                                view.pixel - workstation::eccentricity_px(model, dot, tick.pose),
                                gathered.ticks / kTicksTogether});
      any = true;
    }
    if (any) ++gathered.ticks;
  }
  return gathered;
}

}  // namespace

CameraModel carried(const CameraModel& model, const Vector3d& turn_rad, const Vector3d& shift_m) {
  CameraModel result = model;
  const double angle = turn_rad.norm();
  Matrix3d turn = Matrix3d::Identity();
  if (angle > 0.0) turn = Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
  set_part(result, 0, part(model, 0) + shift_m);
  for (int i = 1; i < parts(model); ++i) {
    if (is_direction(i)) set_part(result, i, turn * part(model, i));
  }
  return result;
}

Result<CameraRepair> repair_camera(const core::Rig& rig, std::size_t camera,
                                   std::span<const workstation::RecordedTick> ticks,
                                   const std::optional<MatrixXd>& covariance_before) {
  Gathered gathered = gather(rig, camera, ticks);
  if (gathered.ticks < kFewestTicks || gathered.views.size() < kFewestViews) {
    return fail(
        fmt::format("{} views of dots in {} ticks while it was left out; expected {} in {} "
                    "or more, in different places",
                    gathered.views.size(), gathered.ticks, kFewestViews, kFewestTicks));
  }
  CameraRepair repair;
  repair.ticks = gathered.ticks;
  repair.views = gathered.views.size();
  const CameraModel& old = rig.cameras[camera].model;
  Fit fit(old, std::move(gathered.views));
  const bool arrived = fit.run();
  const Matrix6d of_pose = fit.pose_covariance();
  repair.turn_sigma_rad = of_pose.diagonal().head<3>().cwiseSqrt();
  repair.shift_sigma_m = of_pose.diagonal().tail<3>().cwiseSqrt();
  if (!arrived || !(left_open(of_pose) < kMostLeftOpen)) {
    return fail(
        fmt::format("the {} views in {} ticks do not determine its pose; drive through "
                    "more of its picture, nearer and farther",
                    repair.views, repair.ticks));
  }
  repair.model = fit.model();
  repair.covariance = fit.covariance(of_pose, covariance_before);
  const Eigen::AngleAxisd turn(Fit::rotation_between(old, repair.model));
  repair.turn_rad = turn.angle() * turn.axis();
  repair.shift_m = geometry::centre(repair.model) - geometry::centre(old);
  repair.rms_before_px = fit.rms_px(old);
  repair.rms_px = fit.rms_px(repair.model);
  repair.odd_views = fit.odd_views();
  return repair;
}

}  // namespace dottrack::calibrate
