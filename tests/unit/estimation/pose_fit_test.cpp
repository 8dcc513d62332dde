// The pose from all views: what it rests on and what it takes into account.

#include "app/core/estimation/pose_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/estimation/room_of_dots.h"

namespace dottrack::estimation {
namespace {

using test::error_of;
using test::RoomOfDots;
using test::Vector3d;

constexpr double kSigma_px = 0.03;

class PoseFitTest : public testing::Test {
 protected:
  PoseFitStatus fit(const DotObservations& views, const geometry::RigidMotion& start,
                    const CaptureTimes& times = {}) {
    PoseFitter fitter(room_.rig);
    return fitter.fit(as_span(views), times, start, DotSpread::none(), fit_);
  }

  RoomOfDots room_;
  PoseFit fit_;
};

TEST_F(PoseFitTest, RecoversThePoseFromAStepAway) {
  for (int i = 0; i < 200; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    ASSERT_EQ(fit(room_.see(truth, 0.0), room_.near(truth)), PoseFitStatus::ok);
    EXPECT_LT(error_of(fit_.pose, truth).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_EQ(fit_.coordinates, 50);
  }
}

TEST_F(PoseFitTest, TheRowsAreTheDerivativesOfTheReprojections) {
  const geometry::RigidMotion pose = room_.somewhere();
  for (core::TargetDot& dot : room_.rig.target.dots)
    dot.normal = Vector3d(0.1, 0.2, 1.0).normalized();
  CaptureTimes times;
  times.motion = {{0.8, -0.3, 0.1}, {0.1, 0.2, -0.7}};
  for (std::size_t i = 0; i < 5; ++i) times.after_s[i] = 0.01 * static_cast<double>(i) - 0.02;
  const DotObservations views = room_.see(pose, kSigma_px);
  Eccentricities offs;
  find_eccentricities(room_.rig, as_span(views), times, pose, offs);
  ViewRows rows;
  ViewRows forward;
  ViewRows back;
  linearise(room_.rig, as_span(views), offs, times, pose, 0.0, rows);
  ASSERT_EQ(rows.size(), 25U);
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 6; ++axis) {
    const Vector6d step = kStep * Vector6d::Unit(axis);
    linearise(room_.rig, as_span(views), offs, times, stepped(pose, step), 0.0, forward);
    linearise(room_.rig, as_span(views), offs, times, stepped(pose, -step), 0.0, back);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Eigen::Vector2d slope = (back[i].residual - forward[i].residual) / (2.0 * kStep);
      const double tolerance = 1e-6 * rows[i].jacobian.norm();
      EXPECT_LT((slope - rows[i].jacobian.col(axis)).norm(), tolerance) << axis << " " << i;
    }
  }
}

TEST_F(PoseFitTest, DotsThatOneCameraSeesCount) {
  const geometry::RigidMotion truth = room_.somewhere();
  const DotObservations all = room_.see(truth, 0.0);
  DotObservations views;  // each dot by another camera
  for (const DotObservation& view : all) {
    if (view.camera == view.dot) views.push_back(view);
  }
  ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
  EXPECT_LT(error_of(fit_.pose, truth).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(fit_.coordinates, 10);
}

// Three dots in one picture are the least that determines a pose, near a pose that is known.
TEST_F(PoseFitTest, SixCoordinatesAreEnoughAndFiveAreNot) {
  const geometry::RigidMotion truth = room_.somewhere();
  DotObservations views = room_.see(truth, 0.0);
  views.resize(3);
  ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
  EXPECT_LT(error_of(fit_.pose, truth).cwiseAbs().maxCoeff(), 1e-6);
  views.resize(2);
  EXPECT_EQ(fit(views, truth), PoseFitStatus::too_few_views);
}

TEST_F(PoseFitTest, TwoDotsDetermineNoPoseHoweverManyCamerasSeeThem) {
  const geometry::RigidMotion truth = room_.somewhere();
  DotObservations views;
  for (const DotObservation& view : room_.see(truth, kSigma_px)) {
    if (view.dot < 2) views.push_back(view);
  }
  ASSERT_EQ(views.size(), 10U);
  EXPECT_EQ(fit(views, truth), PoseFitStatus::degenerate);
}

TEST_F(PoseFitTest, DotsOnALineDoNotHoldTheRoll) {
  for (std::size_t dot = 0; dot < 5; ++dot) {
    room_.rig.target.dots[dot].position_m = Vector3d(0.2 * static_cast<double>(dot), 0.0, 0.0);
  }
  const geometry::RigidMotion truth = room_.somewhere();
  EXPECT_EQ(fit(room_.see(truth, kSigma_px), truth), PoseFitStatus::degenerate);
}

TEST_F(PoseFitTest, TheOrderOfCamerasAndDotsDoesNotMatter) {
  for (int i = 0; i < 100; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    DotObservations views = room_.see(truth, kSigma_px);
    const geometry::RigidMotion start = room_.near(truth);
    ASSERT_EQ(fit(views, start), PoseFitStatus::ok);
    const core::Pose first = fit_.pose;
    std::shuffle(views.begin(), views.end(), room_.random);
    ASSERT_EQ(fit(views, start), PoseFitStatus::ok);
    EXPECT_LT((fit_.pose.position_m - first.position_m).norm(), 1e-12);
    EXPECT_LT(fit_.pose.orientation.angularDistance(first.orientation), 1e-7);
    EXPECT_LT((fit_.pose.covariance - first.covariance).norm(), 1e-9 * first.covariance.norm());
  }
}

// Cameras expose up to 40 ms apart, at 1.5 m/s and 2 rad/s.
TEST_F(PoseFitTest, CamerasNeedNotExposeTogether) {
  CaptureTimes times;
  times.motion = {{1.2, 0.9, 0.0}, {0.0, 0.1, 2.0}};
  for (std::size_t i = 0; i < 5; ++i) times.after_s[i] = 0.01 * static_cast<double>(i) - 0.02;
  for (int i = 0; i < 50; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    DotObservations views = room_.see(truth, 0.0);
    for (DotObservation& view : views) {
      const Vector3d lever = truth.rotation * room_.rig.target.dots[view.dot].position_m;
      const Vector3d place = truth.translation_m + lever +
                             times.after_s[view.camera] *
                                 (times.motion.velocity_m_s + times.motion.turn_rad_s.cross(lever));
      ASSERT_EQ(geometry::project(room_.rig.cameras[view.camera].model, place, view.centre_px),
                geometry::OpticsStatus::ok);
    }
    ASSERT_EQ(fit(views, room_.near(truth), times), PoseFitStatus::ok);
    EXPECT_LT(error_of(fit_.pose, truth).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// A target whose dots are 1 mm off what its file says: the residuals say so, and the covariance.
TEST_F(PoseFitTest, ResidualsBeyondChanceWidenTheCovariance) {
  const geometry::RigidMotion truth = room_.somewhere();
  ASSERT_EQ(fit(room_.see(truth, kSigma_px), truth), PoseFitStatus::ok);
  const double calm = fit_.pose.covariance.trace();
  std::normal_distribution<double> normal(0.0, 0.005);
  RoomOfDots bent = room_;
  for (core::TargetDot& dot : bent.rig.target.dots) {
    dot.position_m += Vector3d(normal(room_.random), normal(room_.random), normal(room_.random));
  }
  ASSERT_EQ(fit(bent.see(truth, kSigma_px), truth), PoseFitStatus::ok);
  EXPECT_GT(fit_.pose.covariance.trace(), 20.0 * calm);
  EXPECT_GT(fit_.coordinates, 25);
}

// A disc's outline is not centred where its centre is shown: at 3 m by a tenth of a pixel.
TEST_F(PoseFitTest, TheEccentricityOfTheOutlinesIsTakenOff) {
  for (core::TargetDot& dot : room_.rig.target.dots) {
    dot.normal = Vector3d::UnitZ();
    dot.diameter_m = 0.2;
  }
  double plain = 0.0;
  double corrected = 0.0;
  for (int i = 0; i < 100; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    DotObservations views = room_.see(truth, 0.0);
    for (DotObservation& view : views) {
      const geometry::CameraModel& model = room_.rig.cameras[view.camera].model;
      const core::TargetDot& dot = room_.rig.target.dots[view.dot];
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      Eigen::Vector2d ends[2];
      // The middle of two opposite chords' middles: an ellipse's centre from eight of its points.
      Eigen::Matrix<double, 8, 5> conic;
      for (int k = 0; k < 8; ++k) {
        const double angle = 0.7853981633974483 * k;
        const Vector3d rim =
            dot.position_m + 0.5 * dot.diameter_m * Vector3d(std::cos(angle), std::sin(angle), 0.0);
        ASSERT_EQ(geometry::project(model, truth * rim, ends[0]), geometry::OpticsStatus::ok);
        const Eigen::Vector2d p = ends[0] - view.centre_px;
        conic.row(k) << p.x() * p.x(), p.x() * p.y(), p.y() * p.y(), p.x(), p.y();
      }
      const Eigen::Matrix<double, 5, 1> c =
          conic.colPivHouseholderQr().solve(Eigen::Matrix<double, 8, 1>::Ones());
      Eigen::Matrix2d square;
      square << 2.0 * c[0], c[1], c[1], 2.0 * c[2];
      sum = -square.inverse() * Eigen::Vector2d(c[3], c[4]);
      view.centre_px += sum;
    }
    ASSERT_EQ(fit(views, room_.near(truth)), PoseFitStatus::ok);
    corrected += error_of(fit_.pose, truth).head<3>().norm();
    RoomOfDots without = room_;
    for (core::TargetDot& dot : without.rig.target.dots) dot.normal.reset();
    PoseFitter fitter(without.rig);
    ASSERT_EQ(fitter.fit(as_span(views), {}, truth, DotSpread::none(), fit_), PoseFitStatus::ok);
    plain += error_of(fit_.pose, truth).head<3>().norm();
  }
  EXPECT_GT(plain / 100, 1e-4);
  EXPECT_LT(corrected, 0.02 * plain);
}

}  // namespace
}  // namespace dottrack::estimation
