// Every partial derivative against fourth-order differences of the function itself, over random
// cameras, and the way there and back.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/unit/geometry/random_cameras.h"

namespace dottrack::geometry {
namespace {

using test::RandomCameras;

constexpr int kSamples = 2000;
constexpr int kEnough = 1900;  // the rest may lie outside a random lens's domain
constexpr double kStep = 1e-3;
constexpr double kTolerance = 1e-6;
constexpr double kDegree = std::numbers::pi / 180.0;

// What a family of random cameras is made of.
struct Family {
  const char* name;
  double linearity;  // CAHVORE only
  double largest_angle_rad;
  CameraModel (*make)(RandomCameras&, double linearity);
};

CameraModel make_cahv(RandomCameras& random, double) {
  return random.cahv();
}
CameraModel make_cahvor(RandomCameras& random, double) {
  return random.cahvor();
}
CameraModel make_cahvore(RandomCameras& random, double linearity) {
  return random.cahvore(linearity);
}

class Derivatives : public testing::TestWithParam<Family> {
 protected:
  CameraModel next_model() { return GetParam().make(random_, GetParam().linearity); }
  Eigen::Vector3d next_point(const CameraModel& model) {
    const Eigen::Vector3d axis = std::visit([](const auto& m) { return m.a; }, model);
    return random_.point_near(centre(model), axis, GetParam().largest_angle_rad, 0.5, 10.0);
  }

  RandomCameras random_{20240607};
};

// (f(-2h) - 8 f(-h) + 8 f(h) - f(2h)) / 12h along one input; false when the function leaves its
// domain on the way.
template <class Function, class Value>
bool difference(const Function& function, double step, Value& slope) {
  constexpr std::array<double, 4> kOffsets = {-2.0, -1.0, 1.0, 2.0};
  constexpr std::array<double, 4> kWeights = {1.0, -8.0, 8.0, -1.0};
  slope.setZero();
  for (std::size_t i = 0; i < 4; ++i) {
    Value value;
    if (!function(kOffsets[i] * step, value)) return false;
    slope += kWeights[i] / (12.0 * step) * value;
  }
  return true;
}

bool projection_differences(const CameraModel& model, const Eigen::Vector3d& point,
                            ProjectionJacobian& out) {
  const double step_m = kStep * (point - centre(model)).norm();
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector2d slope;
    const auto moved = [&](double offset, Eigen::Vector2d& pixel) {
      return project(model, point + offset * Eigen::Vector3d::Unit(k), pixel) == OpticsStatus::ok;
    };
    if (!difference(moved, step_m, slope)) return false;
    out.col(k) = slope;
  }
  return true;
}

bool ray_differences(const CameraModel& model, const Eigen::Vector2d& pixel, RayJacobian& out) {
  using Both = Eigen::Matrix<double, 6, 1>;
  for (int k = 0; k < 2; ++k) {
    Both slope;
    const auto moved = [&](double offset, Both& both) {
      Ray ray;
      const bool ok =
          unproject(model, pixel + offset * Eigen::Vector2d::Unit(k), ray) == OpticsStatus::ok;
      both << ray.origin, ray.direction;
      return ok;
    };
    if (!difference(moved, 0.1, slope)) return false;
    out.origin.col(k) = slope.head<3>();
    out.direction.col(k) = slope.tail<3>();
  }
  return true;
}

TEST_P(Derivatives, OfProjectionMatchDifferences) {
  int valid = 0;
  for (int i = 0; i < kSamples; ++i) {
    const CameraModel model = next_model();
    const Eigen::Vector3d point = next_point(model);
    Eigen::Vector2d pixel;
    ProjectionJacobian analytic;
    ProjectionJacobian numeric;
    if (project(model, point, pixel, &analytic) != OpticsStatus::ok) continue;
    if (!projection_differences(model, point, numeric)) continue;
    ++valid;
    ASSERT_LE((analytic - numeric).norm(), kTolerance * numeric.norm()) << "sample " << i;
  }
  EXPECT_GE(valid, kEnough);
}

TEST_P(Derivatives, OfRaysMatchDifferences) {
  int valid = 0;
  for (int i = 0; i < kSamples; ++i) {
    const CameraModel model = next_model();
    Eigen::Vector2d pixel;
    if (project(model, next_point(model), pixel) != OpticsStatus::ok) continue;
    Ray ray;
    RayJacobian analytic;
    RayJacobian numeric;
    if (unproject(model, pixel, ray, &analytic) != OpticsStatus::ok) continue;
    if (!ray_differences(model, pixel, numeric)) continue;
    ++valid;
    ASSERT_LE((analytic.direction - numeric.direction).norm(),
              kTolerance * numeric.direction.norm())
        << "sample " << i;
    // The origin is a difference of numbers near 10 m: what is left of them is 1e-13 m a pixel.
    ASSERT_LE((analytic.origin - numeric.origin).norm(), kTolerance * numeric.origin.norm() + 1e-12)
        << "sample " << i;
  }
  EXPECT_GE(valid, kEnough);
}

TEST_P(Derivatives, OfTheDirectionAreTangent) {
  int valid = 0;
  for (int i = 0; i < kSamples; ++i) {
    const CameraModel model = next_model();
    Eigen::Vector2d pixel;
    Ray ray;
    RayJacobian jacobian;
    if (project(model, next_point(model), pixel) != OpticsStatus::ok) continue;
    if (unproject(model, pixel, ray, &jacobian) != OpticsStatus::ok) continue;
    ++valid;
    // CAHVORE's directions are as long as |O|, which is off by up to 1e-5 here.
    const bool exact = !std::holds_alternative<Cahvore>(model);
    EXPECT_NEAR(ray.direction.norm(), 1.0, exact ? 1e-15 : 3e-5);
    const double along = (ray.direction.transpose() * jacobian.direction).norm();
    EXPECT_LE(along, (exact ? 1e-14 : 3e-5) * jacobian.direction.norm());
  }
  EXPECT_GE(valid, kEnough);
}

TEST_P(Derivatives, ChangeNoValueWhenAskedFor) {
  for (int i = 0; i < 200; ++i) {
    const CameraModel model = next_model();
    const Eigen::Vector3d point = next_point(model);
    Eigen::Vector2d with(-1.0, -1.0);
    Eigen::Vector2d without(-1.0, -1.0);
    ProjectionJacobian jacobian;
    ASSERT_EQ(project(model, point, with, &jacobian), project(model, point, without));
    EXPECT_EQ(with, without);
    Ray ray_with;
    Ray ray_without;
    RayJacobian ray_jacobian;
    ASSERT_EQ(unproject(model, with, ray_with, &ray_jacobian), unproject(model, with, ray_without));
    EXPECT_EQ(ray_with.origin, ray_without.origin);
    EXPECT_EQ(ray_with.direction, ray_without.direction);
  }
}

// There and back is the same place only where O is of unit length: neither way normalises it.
CameraModel with_unit_axis(CameraModel model) {
  if (auto* cahvor = std::get_if<Cahvor>(&model)) cahvor->o.normalize();
  if (auto* cahvore = std::get_if<Cahvore>(&model)) cahvore->o.normalize();
  return model;
}

TEST_P(Derivatives, ThereAndBackIsTheSamePoint) {
  int valid = 0;
  for (int i = 0; i < kSamples; ++i) {
    const CameraModel model = with_unit_axis(next_model());
    const Eigen::Vector3d point = next_point(model);
    Eigen::Vector2d pixel;
    if (project(model, point, pixel) != OpticsStatus::ok) continue;
    Ray ray;
    ASSERT_EQ(unproject(model, pixel, ray), OpticsStatus::ok) << "sample " << i;
    ++valid;
    const Eigen::Vector3d to_point = point - ray.origin;
    const double off_m = to_point.cross(ray.direction.normalized()).norm();
    EXPECT_LE(off_m, 1e-12 * to_point.norm()) << "sample " << i;
    EXPECT_GT(to_point.dot(ray.direction), 0.0);
  }
  EXPECT_GE(valid, kEnough);
}

TEST_P(Derivatives, BackAndThereIsTheSamePixel) {
  int valid = 0;
  for (int i = 0; i < kSamples; ++i) {
    const CameraModel model = with_unit_axis(next_model());
    const Eigen::Vector2d pixel(random_.between(0.0, 640.0), random_.between(0.0, 480.0));
    Ray ray;
    if (unproject(model, pixel, ray) != OpticsStatus::ok) continue;
    Eigen::Vector2d again;
    const Eigen::Vector3d point = ray.origin + random_.between(0.5, 10.0) * ray.direction;
    ASSERT_EQ(project(model, point, again), OpticsStatus::ok) << "sample " << i;
    ++valid;
    EXPECT_LE((again - pixel).norm(), 1e-9) << "sample " << i;
  }
  EXPECT_GE(valid, kEnough);
}

INSTANTIATE_TEST_SUITE_P(
    Models, Derivatives,
    testing::Values(Family{"cahv", 1.0, 60.0 * kDegree, make_cahv},
                    Family{"cahvor", 1.0, 40.0 * kDegree, make_cahvor},
                    Family{"cahvore_perspective", 1.0, 60.0 * kDegree, make_cahvore},
                    Family{"cahvore_fish_eye", 0.0, 100.0 * kDegree, make_cahvore},
                    Family{"cahvore_general", 0.37, 100.0 * kDegree, make_cahvore},
                    Family{"cahvore_negative", -0.6, 80.0 * kDegree, make_cahvore}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace dottrack::geometry
