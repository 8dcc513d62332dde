#include "app/core/geometry/camera_model.h"

#include <gtest/gtest.h>

#include <set>
#include <type_traits>
#include <vector>

#include "tests/unit/geometry/random_cameras.h"

namespace dottrack::geometry {
namespace {

constexpr std::size_t kPoints = 300;

std::vector<CameraModel> one_of_each() {
  test::RandomCameras random(11);
  return {random.cahv(), random.cahvor(), random.cahvore(0.0), random.cahvore(1.0)};
}

// Half of them are behind the camera.
std::vector<Eigen::Vector3d> points_around(const CameraModel& model) {
  test::RandomCameras random(12);
  std::vector<Eigen::Vector3d> points(kPoints);
  for (auto& p : points) p = centre(model) + random.between(0.5, 5.0) * random.unit();
  return points;
}

TEST(CameraModel, ProjectAllAgreesWithProject) {
  for (const CameraModel& model : one_of_each()) {
    const std::vector<Eigen::Vector3d> points = points_around(model);
    const Eigen::Vector2d untouched(-7.0, -7.0);
    std::vector<Eigen::Vector2d> plain(kPoints, untouched);
    std::vector<Eigen::Vector2d> pixels(kPoints, untouched);
    std::vector<ProjectionJacobian> jacobians(kPoints);
    std::vector<OpticsStatus> statuses(kPoints, OpticsStatus::not_converged);
    project_all(model, points, pixels, jacobians, statuses);
    std::vector<OpticsStatus> plain_statuses(kPoints, OpticsStatus::not_converged);
    project_all(model, points, plain, plain_statuses);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      Eigen::Vector2d pixel = untouched;
      ProjectionJacobian jacobian;
      ASSERT_EQ(statuses[i], project(model, points[i], pixel, &jacobian));
      ASSERT_EQ(plain_statuses[i], statuses[i]);
      EXPECT_EQ(pixels[i], pixel);
      EXPECT_EQ(plain[i], pixel);
      if (statuses[i] != OpticsStatus::ok) continue;
      ++seen;
      EXPECT_EQ(jacobians[i], jacobian);
    }
    EXPECT_GE(seen, 50U) << class_name(model);
    EXPECT_LT(seen, kPoints) << class_name(model);
  }
}

TEST(CameraModel, UnprojectAllAgreesWithUnproject) {
  test::RandomCameras random(13);
  for (const CameraModel& model : one_of_each()) {
    std::vector<Eigen::Vector2d> pixels(kPoints);
    for (auto& p : pixels) p = {random.between(-200.0, 840.0), random.between(-200.0, 680.0)};
    std::vector<Ray> plain(kPoints);
    std::vector<Ray> rays(kPoints);
    std::vector<RayJacobian> jacobians(kPoints);
    std::vector<OpticsStatus> statuses(kPoints);
    unproject_all(model, pixels, rays, jacobians, statuses);
    std::vector<OpticsStatus> plain_statuses(kPoints);
    unproject_all(model, pixels, plain, plain_statuses);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      Ray ray;
      RayJacobian jacobian;
      ASSERT_EQ(statuses[i], unproject(model, pixels[i], ray, &jacobian));
      ASSERT_EQ(plain_statuses[i], statuses[i]);
      EXPECT_EQ(rays[i].origin, ray.origin);
      EXPECT_EQ(rays[i].direction, ray.direction);
      EXPECT_EQ(plain[i].direction, ray.direction);
      if (statuses[i] != OpticsStatus::ok) continue;
      ++seen;
      EXPECT_EQ(jacobians[i].direction, jacobian.direction);
      EXPECT_EQ(jacobians[i].origin, jacobian.origin);
    }
    EXPECT_GE(seen, 250U) << class_name(model);
  }
}

TEST(CameraModel, OfNoPointsIsNothing) {
  for (const CameraModel& model : one_of_each()) {
    project_all(model, {}, {}, {});
    unproject_all(model, {}, {}, {});
  }
}

TEST(CameraModel, CentreIsC) {
  for (const CameraModel& model : one_of_each()) {
    EXPECT_EQ(centre(model), std::visit([](const auto& m) { return m.c; }, model));
  }
}

TEST(CameraModel, ClassesHaveTheirNames) {
  EXPECT_EQ(class_name(Cahv{}), "CAHV");
  EXPECT_EQ(class_name(Cahvor{}), "CAHVOR");
  EXPECT_EQ(class_name(Cahvore{}), "CAHVORE");
}

TEST(CameraModel, StatusesAreOneWordEach) {
  EXPECT_EQ(to_string(OpticsStatus::ok), "ok");
  EXPECT_EQ(to_string(OpticsStatus::behind), "behind");
  EXPECT_EQ(to_string(OpticsStatus::at_centre), "at_centre");
  EXPECT_EQ(to_string(OpticsStatus::outside_domain), "outside_domain");
  EXPECT_EQ(to_string(OpticsStatus::not_converged), "not_converged");
  EXPECT_EQ(to_string(OpticsStatus::not_finite), "not_finite");
}

TEST(CameraModel, IsPlainData) {
  EXPECT_TRUE(std::is_nothrow_move_constructible_v<CameraModel>);
  EXPECT_LE(sizeof(CameraModel), 192U);
}

}  // namespace
}  // namespace dottrack::geometry
