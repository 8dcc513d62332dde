// Points behind, beside, at and far from five cameras: what each must come to. A verdict of its own
// for every row of the reference table, so that none passes unconsidered.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "app/config/camera_file.h"
#include "tests/support/shared_data.h"
#include "tests/unit/geometry/table.h"

namespace dottrack::geometry {
namespace {

using test::Table;

// same: the numbers of the table. back: ok, and the ray projects to the pixel it came from, where
// the table has no converged answer.
enum class Verdict { same, back, behind, at_centre, outside };
using enum Verdict;

using Verdicts = std::map<std::string, Verdict>;  // by kind of row

// A pinhole sees up to 90 degrees off A, however far outside any image that is.
const Verdicts kCahv = {
    {"on_axis_front", same},   {"on_axis_behind", behind}, {"behind_offaxis", behind},
    {"in_plane_of_C", behind}, {"at_C", at_centre},        {"far_1e6m", same},
    {"near_1mm", same},        {"wide_70deg", same},       {"wide_85deg", same},
    {"wide_100deg", behind},   {"wide_150deg", behind},    {"principal_point", same},
    {"far_outside", same},     {"very_far_outside", same}};

// At 85 degrees the distortion throws the point behind the image plane.
const Verdicts kNavcam = {
    {"on_axis_front", same},   {"on_axis_behind", behind}, {"behind_offaxis", behind},
    {"in_plane_of_C", behind}, {"at_C", at_centre},        {"far_1e6m", same},
    {"near_1mm", same},        {"wide_70deg", same},       {"wide_85deg", outside},
    {"wide_100deg", behind},   {"wide_150deg", behind},    {"principal_point", same},
    {"O_axis_pixel", same},    {"far_outside", same},      {"very_far_outside", back}};

const Verdicts kCeilingWide = {
    {"on_axis_front", same},   {"on_axis_behind", behind}, {"behind_offaxis", behind},
    {"in_plane_of_C", behind}, {"at_C", at_centre},        {"far_1e6m", same},
    {"near_1mm", same},        {"wide_70deg", same},       {"wide_85deg", outside},
    {"wide_100deg", behind},   {"wide_150deg", behind},    {"principal_point", same},
    {"O_axis_pixel", same},    {"far_outside", back},      {"very_far_outside", back}};

// Both lenses see beyond 90 degrees: the reference vectors reach 98 and 110.
const Verdicts kFishEye = {
    {"on_axis_front", same}, {"on_axis_behind", behind}, {"behind_offaxis", behind},
    {"in_plane_of_C", same}, {"at_C", at_centre},        {"far_1e6m", same},
    {"near_1mm", same},      {"wide_70deg", same},       {"wide_85deg", same},
    {"wide_100deg", same},   {"wide_150deg", behind},    {"principal_point", same},
    {"O_axis_pixel", same},  {"far_outside", outside},   {"very_far_outside", outside}};

struct EdgeModel {
  const char* file;
  const Verdicts* verdicts;
};

const std::map<std::string, EdgeModel> kModels = {
    {"cahv_ceiling_down", {"cahv_ceiling_down.cahv", &kCahv}},
    {"cahvor_mer1_navcam_left", {"cahvor_mer1_navcam_left.cahvor", &kNavcam}},
    {"cahvor_ceiling_wide", {"cahvor_ceiling_wide.cahvor", &kCeilingWide}},
    {"cahvore_mer1_fhaz_left", {"cahvore_mer1_fhaz_left.cahvore", &kFishEye}},
    {"cahvore_ceiling_fisheye", {"cahvore_ceiling_fisheye.cahvore", &kFishEye}}};

OpticsStatus status_of(Verdict verdict) {
  if (verdict == behind) return OpticsStatus::behind;
  if (verdict == at_centre) return OpticsStatus::at_centre;
  return verdict == outside ? OpticsStatus::outside_domain : OpticsStatus::ok;
}

void check_projection(const Table& table, std::size_t i, const CameraModel& model,
                      Verdict verdict) {
  const Eigen::Vector3d p(table.number(i, "in0"), table.number(i, "in1"), table.number(i, "in2"));
  Eigen::Vector2d pixel(-7.0, -7.0);
  EXPECT_EQ(project(model, p, pixel), status_of(verdict));
  if (verdict == same) {
    EXPECT_NEAR(pixel.x(), table.number(i, "out0"), 1e-9);
    EXPECT_NEAR(pixel.y(), table.number(i, "out1"), 1e-9);
  } else {
    EXPECT_EQ(pixel, Eigen::Vector2d(-7.0, -7.0)) << "an output was written";
  }
}

void check_ray(const Table& table, std::size_t i, const CameraModel& model, Verdict verdict) {
  const Eigen::Vector2d pixel(table.number(i, "in0"), table.number(i, "in1"));
  Ray ray;
  ASSERT_EQ(unproject(model, pixel, ray), status_of(verdict));
  if (verdict == same) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(ray.origin[k], table.number(i, "out" + std::to_string(k)), 1e-12);
      EXPECT_NEAR(ray.direction[k], table.number(i, "out" + std::to_string(k + 3)), 1e-12);
    }
  } else if (verdict == back) {
    EXPECT_EQ(table.text(i, "jpl_status"), "error_reported");
    Eigen::Vector2d again;
    ASSERT_EQ(project(model, ray.origin + 2.0 * ray.direction, again), OpticsStatus::ok);
    // O is of six digits (|O| off by 6e-9) and the pixel up to a hundred images away.
    EXPECT_LE((again - pixel).norm(), 1e-6 * pixel.norm());
  }
}

TEST(EdgeCases, EveryRowHasItsVerdict) {
  const auto data = test::shared_data();
  if (!data) GTEST_SKIP() << "shared data absent: camera_models";
  const auto folder = *data / "camera_models";
  const Table table = Table::read(folder / "edge_cases.csv");
  std::size_t decided = 0;
  for (const auto& [name, edge] : kModels) decided += edge.verdicts->size();
  ASSERT_EQ(table.size(), decided);
  for (std::size_t i = 0; i < table.size(); ++i) {
    SCOPED_TRACE(table.text(i, "model") + " " + table.text(i, "kind"));
    const EdgeModel& edge = kModels.at(table.text(i, "model"));
    const auto file = config::read_camera_file(folder / "models" / edge.file);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    const Verdict verdict = edge.verdicts->at(table.text(i, "kind"));
    if (table.text(i, "dir") == "3d2d") {
      check_projection(table, i, file->model, verdict);
    } else {
      check_ray(table, i, file->model, verdict);
    }
  }
}

}  // namespace
}  // namespace dottrack::geometry
