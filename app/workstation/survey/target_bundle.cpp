#include "app/workstation/survey/target_bundle.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "app/core/geometry/orientation.h"
#include "app/workstation/survey/disc_image.h"

namespace dottrack::workstation {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr int kRounds = 12;
constexpr double kEnough_m = 1e-7;  // no dot moves further in a round
constexpr std::size_t kMostTicks = 1000;
constexpr std::size_t kFewestTicks = 10;
constexpr std::size_t kFewestViews = 20;  // of a dot
constexpr double kHuber = 2.5;            // standard deviations; beyond, a view counts less
constexpr double kLeastSigma_px = 1e-3;
// Noise is not new in every tick: half a shadow stays for some. The scores of so many ticks
// together say how uncertain their sum is.
constexpr std::size_t kTicksTogether = 10;

struct View {
  std::size_t camera;
  std::size_t dot;
  Vector2d pixel;
};

struct Place {  // of the vehicle in one tick
  core::Pose pose;
  std::vector<View> views;
};

// One view at the present estimate.
struct Linear {
  Vector2d residual;
  Eigen::Matrix<double, 2, 6> by_pose;
  Eigen::Matrix<double, 2, 3> by_dot;
  double weight = 1.0;
};

// What a tick says of the dots when its pose is eliminated.
struct Reduced {
  MatrixXd information;
  VectorXd score;
};

class Bundle {
 public:
  Bundle(const core::Rig& rig, std::vector<Place> places)
      : rig_(rig), target_(rig.target), places_(std::move(places)) {}

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      sigma_px_ = robust_sigma();
      if (advance() < kEnough_m) break;
    }
  }

  LearnedTarget result() {
    lay_on_given();
    sigma_px_ = robust_sigma();
    LearnedTarget learned;
    learned.covariance = covariance();
    learned.ticks = places_.size();
    learned.dots.resize(size());
    double sum2 = 0.0;
    double weights = 0.0;
    for (const Place& place : places_) {
      for (const View& view : place.views) {
        const Linear at = linearise(place, view);
        sum2 += at.weight * at.residual.squaredNorm();
        weights += 2.0 * at.weight;
        ++learned.dots[view.dot].views;
        ++learned.views;
      }
    }
    learned.rms_px = std::sqrt(sum2 / weights);
    for (std::size_t i = 0; i < size(); ++i) {
      LearnedDot& dot = learned.dots[i];
      dot.position_m = target_.dots[i].position_m;
      dot.moved_m = dot.position_m - rig_.target.dots[i].position_m;
      const auto row = static_cast<Eigen::Index>(3 * i);
      dot.sigma_m = learned.covariance.diagonal().segment<3>(row).cwiseMax(0.0).cwiseSqrt();
    }
    return learned;
  }

 private:
  std::size_t size() const { return target_.dots.size(); }
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(3 * size()); }

  Linear linearise(const Place& place, const View& view) const {
    const core::TargetDot& dot = target_.dots[view.dot];
    const geometry::CameraModel& model = rig_.cameras[view.camera].model;
    const Matrix3d rotation = place.pose.orientation.toRotationMatrix();
    const Vector3d lever = rotation * dot.position_m;
    Linear at;
    Vector2d pixel;
    geometry::ProjectionJacobian j;
    if (geometry::project(model, place.pose.position_m + lever, pixel, &j) !=
        geometry::OpticsStatus::ok) {
      at.residual.setZero();
      at.by_pose.setZero();
      at.by_dot.setZero();
      at.weight = 0.0;
      return at;
    }
    at.residual = view.pixel - pixel - eccentricity_px(model, dot, place.pose);
    at.by_pose.leftCols<3>() = j;
    for (int row = 0; row < 2; ++row) {
      const Vector3d along = j.row(row).transpose();
      at.by_pose.row(row).tail<3>() = lever.cross(along).transpose();
    }
    at.by_dot = j * rotation;
    const double off = at.residual.norm() / (sigma_px_ * std::sqrt(2.0));
    if (off > kHuber) at.weight = kHuber / off;
    return at;
  }

  // Of a coordinate, from the median of the views' residuals.
  double robust_sigma() const {
    std::vector<double> all;
    for (const Place& place : places_) {
      for (const View& view : place.views) all.push_back(linearise(place, view).residual.norm());
    }
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    constexpr double kMedianOfRayleigh = 1.1774;
    return std::max(*middle / kMedianOfRayleigh, kLeastSigma_px);
  }

  Reduced reduce(const Place& place, Matrix6d& pose_information, Vector6d& pose_score,
                 MatrixXd& cross) const {
    Reduced reduced{MatrixXd::Zero(unknowns(), unknowns()), VectorXd::Zero(unknowns())};
    pose_information.setZero();
    pose_score.setZero();
    cross = MatrixXd::Zero(6, unknowns());
    for (const View& view : place.views) {
      const Linear at = linearise(place, view);
      const auto i = static_cast<Eigen::Index>(3 * view.dot);
      pose_information += at.weight * at.by_pose.transpose() * at.by_pose;
      pose_score += at.weight * at.by_pose.transpose() * at.residual;
      cross.middleCols<3>(i) += at.weight * at.by_pose.transpose() * at.by_dot;
      reduced.information.block<3, 3>(i, i) += at.weight * at.by_dot.transpose() * at.by_dot;
      reduced.score.segment<3>(i) += at.weight * at.by_dot.transpose() * at.residual;
    }
    const Eigen::LDLT<Matrix6d> factor(pose_information);
    reduced.information -= cross.transpose() * factor.solve(cross);
    reduced.score -= cross.transpose() * factor.solve(pose_score);
    return reduced;
  }

  // Columns: the dots' motions that are rigid ones of them all, orthonormal.
  MatrixXd rigid_motions() const {
    MatrixXd motions(unknowns(), 6);
    for (std::size_t i = 0; i < size(); ++i) {
      const Vector3d& p = target_.dots[i].position_m;
      const auto row = static_cast<Eigen::Index>(3 * i);
      motions.block<3, 3>(row, 0).setIdentity();
      for (int axis = 0; axis < 3; ++axis) {
        motions.block<3, 1>(row, 3 + axis) = Vector3d::Unit(axis).cross(p);
      }
    }
    return Eigen::HouseholderQR<MatrixXd>(motions).householderQ() *
           MatrixXd::Identity(unknowns(), 6);
  }

  // The inverse of the dots' information, none of it in the rigid motions.
  MatrixXd inverse(const MatrixXd& information) const {
    const MatrixXd free = rigid_motions();
    const double scale = information.trace() / static_cast<double>(unknowns());
    const MatrixXd whole = information + scale * free * free.transpose();
    const MatrixXd inverted = whole.ldlt().solve(MatrixXd::Identity(unknowns(), unknowns()));
    const MatrixXd kept = MatrixXd::Identity(unknowns(), unknowns()) - free * free.transpose();
    return kept * inverted * kept;
  }

  // One Gauss-Newton step of everything; how far the dot that moved most has moved.
  double advance() {
    MatrixXd information = MatrixXd::Zero(unknowns(), unknowns());
    VectorXd score = VectorXd::Zero(unknowns());
    std::vector<Matrix6d> pose_information(places_.size());
    std::vector<Vector6d> pose_score(places_.size());
    std::vector<MatrixXd> cross(places_.size());
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Reduced part = reduce(places_[k], pose_information[k], pose_score[k], cross[k]);
      information += part.information;
      score += part.score;
    }
    const VectorXd step = inverse(information) * score;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      move(places_[k].pose, pose_information[k].ldlt().solve(pose_score[k] - cross[k] * step));
    }
    double furthest = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vector3d by = step.segment<3>(static_cast<Eigen::Index>(3 * i));
      target_.dots[i].position_m += by;
      furthest = std::max(furthest, by.norm());
    }
    return furthest;
  }

  static void move(core::Pose& pose, const Vector6d& step) {
    pose.position_m += step.head<3>();
    const double angle = step.tail<3>().norm();
    if (angle == 0.0) return;
    pose.orientation = Eigen::AngleAxisd(angle, step.tail<3>() / angle) * pose.orientation;
    pose.orientation.normalize();
  }

  // The rigid motion that lays the learned dots on the given ones; the poses undo it.
  void lay_on_given() {
    std::vector<Vector3d> learned;
    std::vector<Vector3d> given;
    for (std::size_t i = 0; i < size(); ++i) {
      learned.push_back(target_.dots[i].position_m);
      given.push_back(rig_.target.dots[i].position_m);
    }
    geometry::RigidMotion motion;
    if (geometry::absolute_orientation(learned, given, motion) != geometry::OrientationStatus::ok) {
      return;
    }
    for (std::size_t i = 0; i < size(); ++i) target_.dots[i].position_m = motion * learned[i];
    for (Place& place : places_) {
      place.pose.orientation = place.pose.orientation * motion.rotation.conjugate();
      place.pose.position_m -= place.pose.orientation * motion.translation_m;
    }
  }

  // By how the ticks' scores scatter in groups, which counts what neighbours in time share; never
  // less than white noise of the residuals' size would make it.
  MatrixXd covariance() const {
    MatrixXd information = MatrixXd::Zero(unknowns(), unknowns());
    MatrixXd scatter = MatrixXd::Zero(unknowns(), unknowns());
    VectorXd group = VectorXd::Zero(unknowns());
    double weighted2 = 0.0;
    double freedom = -static_cast<double>(unknowns()) + 6.0;
    std::size_t groups = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      Matrix6d pose_information;
      Vector6d pose_score;
      MatrixXd cross;
      const Reduced part = reduce(places_[k], pose_information, pose_score, cross);
      information += part.information;
      group += part.score;
      freedom -= 6.0;
      for (const View& view : places_[k].views) {
        const Linear at = linearise(places_[k], view);
        weighted2 += at.weight * at.residual.squaredNorm();
        freedom += 2.0 * at.weight;
      }
      if ((k + 1) % kTicksTogether != 0 && k + 1 != places_.size()) continue;
      scatter += group * group.transpose();
      group.setZero();
      ++groups;
    }
    const MatrixXd inverted = inverse(information);
    const double white = weighted2 / std::max(freedom, 1.0);
    const double few =
        static_cast<double>(groups) / std::max(static_cast<double>(groups) - 1.0, 1.0);
    const MatrixXd robust = few * inverted * scatter * inverted;
    const double mean_ratio = robust.trace() / std::max((white * inverted).trace(), 1e-30);
    return std::max(mean_ratio, 1.0) * white * inverted;
  }

  const core::Rig& rig_;
  core::Target target_;
  std::vector<Place> places_;
  double sigma_px_ = 1.0;
};

// At most kMostTicks of them, evenly, each with enough views for a pose.
std::vector<Place> places_of(std::span<const RecordedTick> ticks) {
  std::vector<Place> places;
  const std::size_t stride = 1 + ticks.size() / kMostTicks;
  for (std::size_t k = 0; k < ticks.size(); k += stride) {
    Place place;
    place.pose = ticks[k].pose;
    for (const RecordedView& view : ticks[k].views) {
      if (!view.moved) place.views.push_back({view.camera, view.dot, view.pixel});
    }
    if (place.views.size() >= 6) places.push_back(std::move(place));
  }
  return places;
}

}  // namespace

Result<LearnedTarget> learn_target(const core::Rig& rig, std::span<const RecordedTick> ticks) {
  std::vector<Place> places = places_of(ticks);
  if (places.size() < kFewestTicks) {
    return fail(fmt::format("{} ticks have a pose; expected {} or more, in different places",
                            places.size(), kFewestTicks));
  }
  std::vector<std::size_t> views(rig.target.dots.size());
  for (const Place& place : places) {
    for (const View& view : place.views) ++views[view.dot];
  }
  const auto least = std::min_element(views.begin(), views.end());
  if (*least < kFewestViews) {
    return fail(fmt::format("dot {} of the target was seen {} times; expected {} or more",
                            least - views.begin(), *least, kFewestViews));
  }
  Bundle bundle(rig, std::move(places));
  bundle.run();
  return bundle.result();
}

}  // namespace dottrack::workstation
