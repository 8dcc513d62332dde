#include "app/workstation/calibrate/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/config/camera_file.h"
#include "app/config/rig_file.h"
#include "app/workstation/calibrate/report/error_map.h"
#include "app/workstation/calibrate/report/rig_files.h"
#include "tests/unit/workstation/calibrate/synthetic_hall.h"

namespace dottrack::calibrate {
namespace {

struct Calibrated {
  test::Hall hall;
  Calibration calibration;
};

const Calibrated& calibrated() {
  static const Calibrated kCalibrated = [] {
    test::HallOptions options;
    options.cameras = 4;
    options.seed = 21;
    Calibrated out;
    out.hall = test::make_hall(options);
    out.hall.views[0].name = "north_west";
    out.hall.dots[out.hall.views[0].observations[2].dot].name = "a<b>&'c'";
    CalibrationOptions quick;
    quick.folds = 3;
    const auto found = calibrate(out.hall.dots, out.hall.views, quick);
    EXPECT_TRUE(found);
    if (found) out.calibration = *found;
    out.calibration.suspects.push_back(
        {out.hall.views[0].observations[2].dot, "a<b>&'c'", {0.01, 0.0, -0.02}, 9.5});
    return out;
  }();
  return kCalibrated;
}

// Every element that opens closes, in order; no name of one is left open.
bool well_formed(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = text.substr(at + 1, end - at - 1);
    if (tag.front() == '!' || tag.back() == '/') continue;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
      continue;
    }
    open.push_back(tag.substr(0, tag.find_first_of(" \n")));
  }
  return open.empty();
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(CalibrationReport, IsOneFileThatSaysEverything) {
  const Calibrated& c = calibrated();
  const std::string html =
      report_html(c.calibration, c.hall.dots, {"Hall & more", 0.5, {"12 blobs were no dots"}});
  if (const char* const keep = std::getenv("DOTTRACK_KEEP_REPORT")) std::ofstream(keep) << html;
  EXPECT_TRUE(well_formed(html));
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
  EXPECT_NE(html.find("<h1>Hall &amp; more</h1>"), std::string::npos);
  EXPECT_NE(html.find("12 blobs were no dots"), std::string::npos);
  EXPECT_NE(html.find("a&lt;b&gt;&amp;&#39;c&#39;"), std::string::npos);
  EXPECT_EQ(count_of(html, "<svg"), 5U);  // four cameras and the map
  EXPECT_EQ(count_of(html, "<h3>"), 4U);
  std::size_t views = 0;
  for (const CameraCalibration& camera : c.calibration.cameras) {
    EXPECT_GE(count_of(html, camera.name), 3U);
    char number[32];
    std::snprintf(number, sizeof number, "<td>%.3f</td>", camera.holdout_rms_px);
    EXPECT_NE(html.find(number), std::string::npos) << camera.name;
    views += camera.residuals.size();
  }
  EXPECT_EQ(count_of(html, "r='1.8'"), views);
}

TEST(CalibrationReport, MapsTheExpectedError) {
  const Calibrated& c = calibrated();
  const ErrorMap map = error_map(c.calibration, c.hall.dots, 0.3);
  ASSERT_EQ(map.error_m.size(), map.columns * map.rows);
  ASSERT_GT(map.error_m.size(), 100U);
  std::size_t known = 0;
  for (std::size_t i = 0; i < map.error_m.size(); ++i) {
    EXPECT_EQ(std::isfinite(map.error_m[i]), map.cameras[i] >= 2);
    known += std::isfinite(map.error_m[i]) ? 1U : 0U;
  }
  EXPECT_GT(known, 100U);
  EXPECT_GT(map.median_m(), 1e-4);
  EXPECT_LT(map.median_m(), 5e-3);
  EXPECT_GE(map.worst_m(), map.median_m());
}

TEST(CalibrationReport, ModelsAreMoreUncertainOutsideOfTheDots) {
  const Calibrated& c = calibrated();
  const CameraCalibration& camera = c.calibration.cameras[0];
  const auto at = [&](const Eigen::Vector2d& pixel) {
    geometry::Ray ray;
    EXPECT_EQ(unproject(camera.model, pixel, ray), geometry::OpticsStatus::ok);
    Eigen::Matrix2d covariance;
    geometry::ProjectionJacobian ignored;
    EXPECT_TRUE(model_covariance(camera, ray.origin + 6.0 * ray.direction, covariance, ignored));
    return std::sqrt(covariance.trace());
  };
  EXPECT_GT(at({4.0, 4.0}), 1.5 * at({320.0, 240.0}));
  EXPECT_GT(at({320.0, 240.0}), 0.005);
}

class RigFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("calibrated_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }

  void write(const std::vector<RigFile>& files) const {
    for (const RigFile& f : files) std::ofstream(folder_ / f.name, std::ios::binary) << f.text;
  }

  std::filesystem::path folder_;
};

TEST_F(RigFilesTest, MakeARigThatLoads) {
  const auto target = folder_ / "given.csv";
  std::ofstream(target) << "dot,x_m,y_m,z_m,diameter_m\n1,0,0,0,0.05\n2,0.5,0,0,0.05\n"
                           "3,0,0.3,0,0.05\n4,0.4,0.25,0.2,0.05\n";
  const auto files = rig_files(calibrated().calibration, {.name = "hall", .target = target});
  ASSERT_TRUE(files) << files.error().message;
  std::filesystem::create_directories(folder_);
  write(*files);
  const auto rig = config::load_rig(folder_ / "rig.toml", config::Targets::taken_as_they_are);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->name, "hall");
  ASSERT_EQ(rig->cameras.size(), 4U);
  EXPECT_EQ(rig->cameras[0].name, "north_west");
  EXPECT_TRUE(rig->warnings.empty());
  EXPECT_TRUE(rig->rig.model_correlations.known());
}

TEST_F(RigFilesTest, KeepModelsAndCovariancesExactly) {
  const Calibration& calibration = calibrated().calibration;
  const auto files = rig_files(calibration, {});
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 6U);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto read = config::parse_camera_text((*files)[i].text, (*files)[i].name);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_TRUE(read->covariance);
    EXPECT_EQ(*read->covariance, calibration.cameras[i].covariance);
    EXPECT_EQ(geometry::centre(read->model), geometry::centre(calibration.cameras[i].model));
    ASSERT_TRUE(read->dimensions);
    EXPECT_EQ(read->dimensions->columns, test::kHallColumns);
  }
}

TEST_F(RigFilesTest, SayWhereATargetIsMissing) {
  const auto files = rig_files(calibrated().calibration, {});
  ASSERT_TRUE(files);
  EXPECT_NE(files->back().text.find("Not complete"), std::string::npos);
  EXPECT_NE(files->back().text.find("# [target]"), std::string::npos);
  const auto none = rig_files(calibrated().calibration, {.target = folder_ / "none.csv"});
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("none.csv"), std::string::npos);
}

}  // namespace
}  // namespace dottrack::calibrate
