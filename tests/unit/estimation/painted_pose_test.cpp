// From painted pixels to the pose: as good as the light allows, and as good as it says.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <memory>
#include <numbers>

#include "app/core/estimation/pose_fit.h"
#include "app/core/image/dot_fit.h"
#include "app/core/image/identify.h"
#include "tests/unit/estimation/room_of_dots.h"
#include "tests/unit/image/painted_dot.h"

namespace dottrack::estimation {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using image::test::PaintedEllipse;
using test::RoomOfDots;

constexpr int kSide_px = 48;
constexpr double kLevel_dn = 40.0;
constexpr double kContrast_dn = 120.0;
constexpr double kBlur_px = 0.65;
constexpr double kNoise_dn = 3.0;

// The ellipse through the outline of a disc as a camera shows it, from eight of its points.
PaintedEllipse shown(const geometry::CameraModel& model, const geometry::RigidMotion& pose,
                     const core::TargetDot& dot) {
  const Vector3d u = dot.normal->unitOrthogonal();
  const Vector3d w = dot.normal->cross(u);
  std::vector<Vector2d> rim;
  Vector2d middle = Vector2d::Zero();
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4.0;
    const Vector3d place =
        dot.position_m + 0.5 * dot.diameter_m * (std::cos(angle) * u + std::sin(angle) * w);
    rim.emplace_back();
    EXPECT_EQ(geometry::project(model, pose * place, rim.back()), geometry::OpticsStatus::ok);
    middle += rim.back() / 8.0;
  }
  Eigen::Matrix<double, 8, 5> rows;
  for (int k = 0; k < 8; ++k) {
    const Vector2d p = rim[static_cast<std::size_t>(k)] - middle;
    rows.row(k) << p.x() * p.x(), p.x() * p.y(), p.y() * p.y(), p.x(), p.y();
  }
  const Eigen::Matrix<double, 5, 1> c =
      rows.colPivHouseholderQr().solve(Eigen::Matrix<double, 8, 1>::Ones());
  Matrix2d form;
  form << c[0], 0.5 * c[1], 0.5 * c[1], c[2];
  const Vector2d off = -0.5 * form.inverse() * Vector2d(c[3], c[4]);
  const double scale = 1.0 + off.dot(form * off);
  const Eigen::SelfAdjointEigenSolver<Matrix2d> axes(form / scale);
  const Vector2d along = axes.eigenvectors().col(0);
  return {middle + off, 1.0 / std::sqrt(axes.eigenvalues()[0]),
          1.0 / std::sqrt(axes.eigenvalues()[1]), std::atan2(along.y(), along.x())};
}

// Of the centre of a blurred ellipse: the edge's share, (C / s)^2 / (2 sqrt(pi) s_e) times the
// integral of n n' along the outline.
Matrix2d light_information(const PaintedEllipse& e) {
  const double edge_px = std::sqrt(kBlur_px * kBlur_px + 1.0 / 12.0);
  const double per_px =
      std::pow(kContrast_dn / kNoise_dn, 2) / (2.0 * std::sqrt(std::numbers::pi) * edge_px);
  Matrix2d sum = Matrix2d::Zero();
  constexpr int kSteps = 360;
  for (int k = 0; k < kSteps; ++k) {
    const double t = 2.0 * std::numbers::pi * k / kSteps;
    const Vector2d normal(e.semi_minor_px * std::cos(t), e.semi_major_px * std::sin(t));
    sum += normal * normal.transpose() / normal.norm() * (2.0 * std::numbers::pi / kSteps);
  }
  const Matrix2d turn = Eigen::Rotation2Dd(e.angle_rad).toRotationMatrix();
  return per_px * turn * sum * turn.transpose();
}

class PaintedPoseTest : public testing::Test {
 protected:
  PaintedPoseTest() {
    for (core::TargetDot& dot : room_.rig.target.dots) dot.normal = Vector3d::UnitZ();
  }

  // One dot's centre, measured on a picture of it alone; false where it has a flaw.
  bool measure(const PaintedEllipse& truth, Vector2d& centre_px, Matrix2d& covariance_px2) {
    const Vector2d corner = truth.centre.array().floor() - kSide_px / 2;
    PaintedEllipse here = truth;
    here.centre -= corner;
    image::test::Canvas canvas(kSide_px, kBlur_px);
    canvas.add_level(kLevel_dn);
    canvas.paint(&here, {}, kContrast_dn);
    const auto picture = canvas.expose({kNoise_dn, 0.0}, random_);
    identifier_->identify(picture.view(), {.intensity_min_dn = 90}, {.min_area_px = 4}, *regions_);
    if (regions_->size() != 1) return false;
    const image::ExpectedOutline outline{here.semi_major_px, here.semi_minor_px, here.angle_rad};
    const image::DotFit fit = image::fit_dot(picture.view(), (*regions_)[0], &outline);
    centre_px = corner + fit.centre_px;
    covariance_px2 = fit.covariance_px2;
    return fit.flaw == image::DotFlaw::none;
  }

  RoomOfDots room_;
  image::test::Random random_{23};
  std::unique_ptr<image::Identifier> identifier_ = std::make_unique<image::Identifier>();
  std::unique_ptr<image::Regions> regions_ = std::make_unique<image::Regions>();
};

TEST_F(PaintedPoseTest, ReachesTheBoundOfTheLightAndSaysSo) {
  constexpr int kPoses = 300;
  PoseFitter fitter(room_.rig);
  PoseFit fit;
  double error2 = 0.0;
  double turn2 = 0.0;
  double bound2 = 0.0;
  double turn_bound2 = 0.0;
  double nees = 0.0;
  int views_seen = 0;
  for (int i = 0; i < kPoses; ++i) {
    const geometry::RigidMotion truth = room_.somewhere();
    DotObservations views;
    DotObservations bounds;
    for (std::size_t camera = 0; camera < 5; ++camera) {
      for (std::size_t dot = 0; dot < 5; ++dot) {
        const PaintedEllipse ellipse =
            shown(room_.rig.cameras[camera].model, truth, room_.rig.target.dots[dot]);
        Vector2d centre_px;
        Matrix2d covariance_px2;
        if (!measure(ellipse, centre_px, covariance_px2)) continue;
        const auto c = static_cast<std::uint8_t>(camera);
        const auto d = static_cast<std::uint8_t>(dot);
        views.push_back({c, d, centre_px, covariance_px2});
        bounds.push_back({c, d, ellipse.centre, light_information(ellipse).inverse()});
      }
    }
    views_seen += static_cast<int>(views.size());
    ASSERT_EQ(fitter.fit(as_span(views), {}, room_.near(truth), DotSpread::none(), fit),
              PoseFitStatus::ok);
    const Vector6d error = test::error_of(fit.pose, truth);
    error2 += error.head<3>().squaredNorm();
    turn2 += error.tail<3>().squaredNorm();
    nees += test::nees(fit.pose, truth);
    ASSERT_EQ(fitter.fit(as_span(bounds), {}, truth, DotSpread::none(), fit), PoseFitStatus::ok);
    bound2 += fit.pose.covariance.diagonal().head<3>().sum();
    turn_bound2 += fit.pose.covariance.diagonal().tail<3>().sum();
  }
  EXPECT_GT(views_seen, static_cast<int>(0.97 * 25 * kPoses));
  EXPECT_LT(std::sqrt(error2 / bound2), 1.1);
  EXPECT_LT(std::sqrt(turn2 / turn_bound2), 1.1);
  EXPECT_NEAR(nees / kPoses, 6.0, 3.0 * std::sqrt(12.0 / kPoses));
  RecordProperty("position_over_bound", std::to_string(std::sqrt(error2 / bound2)));
  RecordProperty("nees", std::to_string(nees / kPoses));
}

}  // namespace
}  // namespace dottrack::estimation
