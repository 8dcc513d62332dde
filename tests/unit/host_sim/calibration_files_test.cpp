#include "host_sim/scenarios/calibration_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/config/rig_file.h"
#include "host_sim/scenarios/scenario_file.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> places(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "dot,x_m,y_m,z_m,sigma_m,diameter_m,nx,ny,nz");
  std::vector<Vector3d> dots;
  while (std::getline(in, line)) {
    std::istringstream fields(line.substr(line.find(',') + 1));
    Vector3d p;
    char comma = ' ';
    fields >> p.x() >> comma >> p.y() >> comma >> p.z();
    dots.push_back(p);
  }
  return dots;
}

Scene scene() {
  return *load_scenario(*find_scenario("calibration"));
}

TEST(CalibrationFiles, HaveASurveyWithErrorsAndTheTruth) {
  const test::TemporaryFolder folder;
  const Scene hall = scene();
  const auto wrong = write_calibration(hall, {.wrong_dots = 3, .seed = 4}, folder.path());
  ASSERT_TRUE(wrong) << wrong.error().message;
  EXPECT_EQ(wrong->size(), 3U);
  const auto surveyed = places(folder.path() / "dots.csv");
  const auto truth = places(folder.path() / "truth_dots.csv");
  ASSERT_EQ(surveyed.size(), 60U);
  ASSERT_EQ(truth.size(), 60U);
  int far = 0;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double off_m = (surveyed[i] - truth[i]).norm();
    EXPECT_LT(off_m, 0.11);
    far += off_m > 0.02 ? 1 : 0;
    if (off_m < 0.02) sum2 += off_m * off_m;
  }
  EXPECT_EQ(far, 3);
  EXPECT_NEAR(std::sqrt(sum2 / (3.0 * 57.0)), 0.001, 0.0002);
}

TEST(CalibrationFiles, HaveARigThatIsAboutRight) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_calibration(scene(), {}, folder.path()));
  const auto told =
      config::load_rig(folder.path() / "approximate/rig.toml", config::Targets::taken_as_they_are);
  const auto truth =
      config::load_rig(folder.path() / "truth/rig.toml", config::Targets::taken_as_they_are);
  ASSERT_TRUE(told && truth);
  ASSERT_EQ(told->rig.cameras.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto& guess = told->rig.cameras[i].model;
    EXPECT_EQ(geometry::class_name(guess), "CAHV");
    const double off_m =
        (geometry::centre(guess) - geometry::centre(truth->rig.cameras[i].model)).norm();
    EXPECT_GT(off_m, 0.01);
    EXPECT_LT(off_m, 0.6);
  }
}

TEST(CalibrationFiles, EveryCameraSeesTwelveDots) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scene hall = *load_scenario(*find_scenario("calibration"), {.seed = seed, .ticks = {}});
    ASSERT_EQ(hall.calibration_dots, 60U);
    for (const SceneCamera& camera : hall.cameras) {
      int seen = 0;
      for (std::size_t i = 0; i < hall.calibration_dots; ++i) {
        const Mark& dot = hall.world.hall.marks[i];
        const auto pixel = camera.camera.project(dot.centre_m);
        const Vector3d sight = (camera.camera.centre_m() - dot.centre_m).normalized();
        if (pixel && sight.dot(dot.normal) > 0.15 && pixel->x() > 8.0 && pixel->x() < 631.0 &&
            pixel->y() > 8.0 && pixel->y() < 471.0) {
          ++seen;
        }
      }
      EXPECT_GE(seen, 12) << camera.name << " seed " << seed;
    }
  }
}

TEST(CalibrationFiles, NeedAHallWithDots) {
  const test::TemporaryFolder folder;
  Scene hall = scene();
  hall.calibration_dots = 2;
  const auto wrong = write_calibration(hall, {.wrong_dots = 3, .seed = 1}, folder.path());
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message, "the hall has 2 calibration dots; expected 3 or more");
}

}  // namespace
}  // namespace dottrack::host_sim
