#include "app/workstation/calibrate/fit/camera_numbers.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "app/config/camera_internal.h"
#include "app/workstation/calibrate/fit/model_choice.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<LensKind> all_kinds() {
  std::vector<LensKind> kinds = candidates(ModelKind::automatic);
  kinds.push_back({LensForm::pupil, true, true, 0.4});
  kinds.push_back({LensForm::pupil, true, true, -0.5});
  return kinds;
}

class Source {
 public:
  explicit Source(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

 private:
  std::mt19937 engine_;
};

NumberedCamera any_camera(const LensKind& kind, Source& random) {
  NumberedCamera camera;
  camera.kind = kind;
  const Vector3d axis = Vector3d(random(-1, 1), random(-1, 1), random(-1, 1)).normalized();
  camera.frame.rotation = Eigen::AngleAxisd(random(0.0, 3.0), axis).toRotationMatrix();
  camera.frame.centre_m = {random(-3, 3), random(-3, 3), random(2, 5)};
  camera.frame.distance_m = 5.0;
  camera.frame.focal_px = 500.0;
  camera.frame.middle_px = {319.5, 239.5};
  constexpr Numbers kSpread = {0.1,  0.1,  0.1, 0.1,  0.1,  0.1,  0.1,  0.05, 0.05,
                               0.05, 0.01, 0.1, 0.05, 0.05, 0.02, 0.01, 0.01};
  for (int i = 0; i < kNumbers; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (is_free(kind, i)) camera.numbers[k] = random(-kSpread[k], kSpread[k]);
  }
  return camera;
}

Vector3d in_view(const NumberedCamera& camera, Source& random) {
  const double depth = random(1.0, 8.0);
  const Vector3d own(depth * random(-0.6, 0.6), depth * random(-0.45, 0.45), depth);
  return camera.frame.centre_m + camera.frame.rotation.transpose() * own;
}

TEST(CameraNumbers, ProjectAsTheModelDoes) {
  Source random(1);
  int compared = 0;
  for (const LensKind& kind : all_kinds()) {
    for (int trial = 0; trial < 40; ++trial) {
      const NumberedCamera camera = any_camera(kind, random);
      const geometry::CameraModel model = model_of(camera);
      for (int i = 0; i < 20; ++i) {
        const Vector3d p = in_view(camera, random);
        const auto view = linear_view(camera, p);
        Vector2d pixel;
        geometry::ProjectionJacobian jacobian;
        if (!view || project(model, p, pixel, &jacobian) != geometry::OpticsStatus::ok) continue;
        ++compared;
        ASSERT_LT((view->pixel - pixel).norm(), 1e-9 * std::max(1.0, pixel.norm() / 1000.0));
        ASSERT_LT((view->by_point - jacobian).norm(), 1e-6 * jacobian.norm());
      }
    }
  }
  EXPECT_GT(compared, 5000);
}

TEST(CameraNumbers, KnowTheirDerivatives) {
  Source random(2);
  int compared = 0;
  for (const LensKind& kind : all_kinds()) {
    const NumberedCamera camera = any_camera(kind, random);
    const Vector3d p = in_view(camera, random);
    const auto view = linear_view(camera, p);
    ASSERT_TRUE(view);
    for (std::size_t k = 0; k < kNumbers; ++k) {
      constexpr double kStep = 1e-6;
      NumberedCamera ahead = camera;
      NumberedCamera behind = camera;
      ahead.numbers[k] += kStep;
      behind.numbers[k] -= kStep;
      const Vector2d expected =
          (linear_view(ahead, p)->pixel - linear_view(behind, p)->pixel) / (2.0 * kStep);
      const Vector2d found = view->by_numbers.col(static_cast<Eigen::Index>(k));
      EXPECT_LT((found - expected).norm(), 1e-3 + 1e-5 * expected.norm()) << k;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(CameraNumbers, AreTheSameCameraAfterRebasing) {
  Source random(3);
  for (const LensKind& kind : all_kinds()) {
    const NumberedCamera camera = any_camera(kind, random);
    NumberedCamera rebased = camera;
    rebase(rebased);
    for (std::size_t i = 0; i < kScale; ++i) EXPECT_EQ(rebased.numbers[i], 0.0);
    const Eigen::Matrix3d r = rebased.frame.rotation;
    EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    const Vector3d p = in_view(camera, random);
    EXPECT_LT((linear_view(camera, p)->pixel - linear_view(rebased, p)->pixel).norm(), 1e-9);
  }
}

TEST(CameraNumbers, ComeBackFromTheModel) {
  Source random(4);
  for (const LensKind& kind : all_kinds()) {
    NumberedCamera camera = any_camera(kind, random);
    camera.numbers[kSkew] = 0.0;
    const NumberedCamera again = numbered(model_of(camera), {640, 480}, 5.0, kind);
    if (kind.linearity != again.kind.linearity) continue;
    const Vector3d p = in_view(camera, random);
    EXPECT_LT((linear_view(camera, p)->pixel - linear_view(again, p)->pixel).norm(), 1e-8);
  }
}

TEST(CameraNumbers, VectorsFollowTheNumbers) {
  Source random(5);
  for (const LensKind& kind : all_kinds()) {
    NumberedCamera camera = any_camera(kind, random);
    rebase(camera);
    const Eigen::MatrixXd jacobian = vectors_jacobian(camera);
    ASSERT_EQ(jacobian.rows(), kind.form == LensForm::pinhole  ? 12
                               : kind.form == LensForm::radial ? 18
                                                               : 21);
    constexpr double kStep = 1e-6;
    for (std::size_t k = 0; k < kNumbers; ++k) {
      NumberedCamera ahead = camera;
      ahead.numbers[k] += kStep;
      const geometry::Cahv a = config::linear_part(model_of(ahead));
      const geometry::Cahv b = config::linear_part(model_of(camera));
      Eigen::Matrix<double, 12, 1> difference;
      difference << a.c - b.c, a.a - b.a, a.h - b.h, a.v - b.v;
      const auto column = jacobian.col(static_cast<Eigen::Index>(k)).head<12>();
      EXPECT_LT((difference / kStep - column).norm(), 1e-4 * (1.0 + column.norm())) << k;
    }
  }
}

}  // namespace
}  // namespace dottrack::calibrate
