// The models against 400 rows each way of reference vectors: the published equations in 113-bit
// floating point (columns ref_*), derivatives included.

#include <gtest/gtest.h>

#include "app/config/camera_file.h"
#include "tests/support/shared_data.h"
#include "tests/unit/geometry/table.h"

namespace dottrack::geometry {
namespace {

using test::Table;

constexpr std::size_t kRows = 400;
constexpr double kPixelTolerance = 1e-9;
constexpr double kRayTolerance = 1e-12;
constexpr double kDerivativeTolerance = 1e-6;  // relative, over the matrix

struct Reference {
  const char* name;
  const char* file;
};

class ReferenceVectors : public testing::TestWithParam<Reference> {
 protected:
  void SetUp() override {
    const auto data = test::shared_data();
    if (!data) GTEST_SKIP() << "shared data absent: camera_models";
    folder_ = *data / "camera_models";
    const auto file = config::read_camera_file(folder_ / "models" / GetParam().file);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    model_ = file->model;
  }

  Table rows(const std::string& direction) const {
    return Table::read(folder_ / (std::string(GetParam().name) + "_" + direction + ".csv"));
  }

  std::filesystem::path folder_;
  CameraModel model_;
};

// The columns ref_d<of>_d<by>, row-major.
Eigen::MatrixXd matrix(const Table& table, std::size_t row, const std::vector<std::string>& of,
                       const std::vector<std::string>& by) {
  Eigen::MatrixXd m(of.size(), by.size());
  for (int i = 0; i < m.rows(); ++i) {
    for (int j = 0; j < m.cols(); ++j) {
      const auto& value = of[static_cast<std::size_t>(i)];
      m(i, j) = table.number(row, "ref_d" + value + "_d" + by[static_cast<std::size_t>(j)]);
    }
  }
  return m;
}

Eigen::Vector3d vector(const Table& table, std::size_t row, const std::string& name) {
  return {table.number(row, name + "x"), table.number(row, name + "y"),
          table.number(row, name + "z")};
}

TEST_P(ReferenceVectors, ProjectionAndItsDerivatives) {
  const Table table = rows("3d2d");
  ASSERT_EQ(table.size(), kRows);
  for (std::size_t i = 0; i < table.size(); ++i) {
    SCOPED_TRACE("row " + table.text(i, "id"));
    const Eigen::Vector3d point(table.number(i, "X"), table.number(i, "Y"), table.number(i, "Z"));
    Eigen::Vector2d pixel;
    ProjectionJacobian jacobian;
    ASSERT_EQ(project(model_, point, pixel, &jacobian), OpticsStatus::ok);
    EXPECT_NEAR(pixel.x(), table.number(i, "ref_x"), kPixelTolerance);
    EXPECT_NEAR(pixel.y(), table.number(i, "ref_y"), kPixelTolerance);
    const Eigen::MatrixXd expected = matrix(table, i, {"x", "y"}, {"X", "Y", "Z"});
    EXPECT_LE((jacobian - expected).norm(), kDerivativeTolerance * expected.norm());
  }
}

TEST_P(ReferenceVectors, RaysAndTheirDerivatives) {
  const Table table = rows("2d3d");
  ASSERT_EQ(table.size(), kRows);
  for (std::size_t i = 0; i < table.size(); ++i) {
    SCOPED_TRACE("row " + table.text(i, "id"));
    Ray ray;
    RayJacobian jacobian;
    const Eigen::Vector2d pixel(table.number(i, "x"), table.number(i, "y"));
    ASSERT_EQ(unproject(model_, pixel, ray, &jacobian), OpticsStatus::ok);
    EXPECT_LE((ray.origin - vector(table, i, "ref_o")).norm(), kRayTolerance);
    EXPECT_LE((ray.direction - vector(table, i, "ref_u")).norm(), kRayTolerance);
    const Eigen::MatrixXd origin = matrix(table, i, {"ox", "oy", "oz"}, {"x", "y"});
    const Eigen::MatrixXd direction = matrix(table, i, {"ux", "uy", "uz"}, {"x", "y"});
    EXPECT_LE((jacobian.origin - origin).norm(), kDerivativeTolerance * origin.norm());
    EXPECT_LE((jacobian.direction - direction).norm(), kDerivativeTolerance * direction.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Models, ReferenceVectors,
    testing::Values(Reference{"cahv_ceiling_down", "cahv_ceiling_down.cahv"},
                    Reference{"cahvor_mer1_navcam_left", "cahvor_mer1_navcam_left.cahvor"},
                    Reference{"cahvor_ceiling_wide", "cahvor_ceiling_wide.cahvor"},
                    Reference{"cahvore_mer1_fhaz_left", "cahvore_mer1_fhaz_left.cahvore"},
                    Reference{"cahvore_ceiling_fisheye", "cahvore_ceiling_fisheye.cahvore"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace dottrack::geometry
