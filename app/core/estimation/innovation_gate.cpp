#include "app/core/estimation/innovation_gate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dottrack::estimation {
namespace {

// A vehicle may be a little faster than its table says; noise goes on top of that.
constexpr double kBeyondLimits = 1.25;
constexpr double kNoiseSigmas = 4.0;
constexpr double kJumpsBeyondLimits = 5.0;

// A step from the expected pose, in which all cameras of a tick are off alike.
struct Place {
  Vector6d step = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

// Anywhere that the vehicle can be, and so much farther that a jump is seen as one; narrow enough
// to help where the cameras together do not see all of a pose.
Matrix6d anywhere(const ExpectedCameras& cameras, const Reach& reach,
                  const core::MotionLimits& limits) {
  const double translation = kJumpsBeyondLimits * limits.max_speed_m_s * reach.seconds;
  const double rotation = kJumpsBeyondLimits * limits.max_turn_rate_rad_s * reach.seconds;
  Matrix6d covariance = cameras.back().expected;
  covariance.diagonal().head<3>().array() += translation * translation;
  covariance.diagonal().tail<3>().array() += rotation * rotation;
  return covariance;
}

Place place_seen_by(const ExpectedCameras& cameras, CameraSet set, const Matrix6d& prior) {
  Matrix6d information = prior.llt().solve(Matrix6d::Identity());
  Vector6d gradient = Vector6d::Zero();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!set.contains(i)) continue;
    information += cameras[i].views.information;
    gradient += cameras[i].gradient;
  }
  const Eigen::LLT<Matrix6d> factor(information);
  return {factor.solve(gradient), factor.solve(Matrix6d::Identity())};
}

// Above 1: the views of this camera contradict the place.
double contradiction(const ExpectedViews& camera, const Place& place) {
  const Matrix6d& information = camera.views.information;
  return surprise(information, camera.gradient - information * place.step, place.covariance) /
         largest_surprise(camera.views.coordinates);
}

struct Worst {
  std::size_t camera = 0;
  double contradiction = 0.0;
};

// The one that contradicts most what the others of the set say.
Worst worst_of(const ExpectedCameras& cameras, CameraSet set, const Matrix6d& prior) {
  Worst worst;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (!set.contains(i)) continue;
    CameraSet others = set;
    others.erase(i);
    const double c = contradiction(cameras[i], place_seen_by(cameras, others, prior));
    if (c > worst.contradiction) worst = {i, c};
  }
  return worst;
}

// The cameras that agree with one another, found by leaving out the worst until all do.
CameraSet agreeing(const ExpectedCameras& cameras, CameraSet set, const Matrix6d& prior) {
  while (set.size() > 1) {
    const Worst worst = worst_of(cameras, set, prior);
    if (worst.contradiction <= 1.0) break;
    set.erase(worst.camera);
  }
  return set;
}

double sigma_of(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::sqrt(std::max(0.0, a.trace() + b.trace()));
}

bool within_reach(const Place& place, const Reach& reach, const core::MotionLimits& limits) {
  const Vector6d step = reach.from_last + place.step;
  const double far_m = kBeyondLimits * limits.max_speed_m_s * reach.seconds +
                       kNoiseSigmas * sigma_of(place.covariance.topLeftCorner<3, 3>(),
                                               reach.last.topLeftCorner<3, 3>());
  const double far_rad = kBeyondLimits * limits.max_turn_rate_rad_s * reach.seconds +
                         kNoiseSigmas * sigma_of(place.covariance.bottomRightCorner<3, 3>(),
                                                 reach.last.bottomRightCorner<3, 3>());
  return step.head<3>().norm() <= far_m && step.tail<3>().norm() <= far_rad;
}

bool finite(const ExpectedViews& camera) {
  return camera.views.information.allFinite() && camera.gradient.allFinite();
}

// Some cameras contradict what was expected: the majority decides.
void vote(const ExpectedCameras& cameras, CameraSet candidates, const Reach& reach,
          const core::MotionLimits& limits, Judgement& judgement) {
  const Matrix6d prior = anywhere(cameras, reach, limits);
  const CameraSet agree = agreeing(cameras, candidates, prior);
  if (agree.size() <= judgement.accepted.size()) return;
  const Place place = place_seen_by(cameras, agree, prior);
  if (within_reach(place, reach, limits)) {
    judgement.accepted = agree;
  } else if (agree.size() >= 2 && 2 * agree.size() > candidates.size()) {
    judgement.jumped = true;
    judgement.accepted = CameraSet{};
  }
}

}  // namespace

Judgement judge(const ExpectedCameras& cameras, const Reach& reach,
                const core::MotionLimits& limits) {
  Judgement judgement;
  CameraSet candidates;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const ExpectedViews& camera = cameras[i];
    if (!finite(camera)) continue;
    candidates.insert(i);
    judgement.surprise[i] = surprise(camera.views.information, camera.gradient, camera.expected);
    if (judgement.surprise[i] <= largest_surprise(camera.views.coordinates)) {
      judgement.accepted.insert(i);
    }
  }
  if (!(judgement.accepted == candidates)) vote(cameras, candidates, reach, limits, judgement);
  return judgement;
}

}  // namespace dottrack::estimation
