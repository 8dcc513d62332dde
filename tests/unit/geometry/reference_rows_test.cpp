// The models against a few reference rows that the checkout carries with it.

#include "tests/unit/geometry/reference_rows.h"

#include <gtest/gtest.h>

namespace dottrack::geometry {
namespace {

using test::kReferenceCameras;
using test::ProjectionRow;
using test::RayRow;
using test::ReferenceCamera;

using RowMajor23 = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using RowMajor32 = Eigen::Matrix<double, 3, 2, Eigen::RowMajor>;

TEST(ReferenceRows, Projections) {
  for (const ReferenceCamera& camera : kReferenceCameras) {
    for (const ProjectionRow& row : camera.projections) {
      SCOPED_TRACE(camera.name);
      Eigen::Vector2d pixel;
      ProjectionJacobian jacobian;
      ASSERT_EQ(project(camera.model, Eigen::Vector3d(row.point.data()), pixel, &jacobian),
                OpticsStatus::ok);
      EXPECT_LE((pixel - Eigen::Vector2d(row.pixel.data())).norm(), 1e-9);
      const RowMajor23 expected(row.jacobian.data());
      EXPECT_LE((jacobian - expected).norm(), 1e-9 * expected.norm());
    }
  }
}

TEST(ReferenceRows, Rays) {
  for (const ReferenceCamera& camera : kReferenceCameras) {
    for (const RayRow& row : camera.rays) {
      SCOPED_TRACE(camera.name);
      Ray ray;
      RayJacobian jacobian;
      ASSERT_EQ(unproject(camera.model, Eigen::Vector2d(row.pixel.data()), ray, &jacobian),
                OpticsStatus::ok);
      EXPECT_LE((ray.origin - Eigen::Vector3d(row.origin.data())).norm(), 1e-12);
      EXPECT_LE((ray.direction - Eigen::Vector3d(row.direction.data())).norm(), 1e-12);
      const RowMajor32 origin(row.origin_jacobian.data());
      const RowMajor32 direction(row.direction_jacobian.data());
      EXPECT_LE((jacobian.origin - origin).norm(), 1e-9 * origin.norm());
      EXPECT_LE((jacobian.direction - direction).norm(), 1e-9 * direction.norm());
    }
  }
}

}  // namespace
}  // namespace dottrack::geometry
