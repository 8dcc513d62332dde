#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "app/telemetry/pose_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"
#include "tests/unit/telemetry/record_of.h"

namespace dottrack::telemetry {
namespace {

using Row = std::map<std::string, std::string>;

class CsvFile : public testing::Test {
 protected:
  // Two cameras, three dots, a tick with a pose and one without.
  void SetUp() override {
    auto file = OutputFile::create(folder_.path() / "poses.csv");
    ASSERT_TRUE(file);
    CsvWriter writer(*file, {"left", "right"}, 3);
    writer.write(record_with_pose(5));
    writer.write(record_without_pose(6));
    ASSERT_TRUE(file->finish());
    lines_ = lines_of(folder_.path() / "poses.csv");
    ASSERT_EQ(lines_.size(), 3U);
    names_ = split(lines_[0], ',');
  }

  Row row(std::size_t line) const {
    const std::vector<std::string> fields = split(lines_.at(line), ',');
    if (fields.size() != names_.size()) throw std::runtime_error("ragged row: " + lines_[line]);
    Row found;
    for (std::size_t i = 0; i < fields.size(); ++i) found[names_[i]] = fields[i];
    return found;
  }

  test::TemporaryFolder folder_;
  std::vector<std::string> lines_;
  std::vector<std::string> names_;
};

TEST_F(CsvFile, EveryColumnHasANameOfItsOwn) {
  EXPECT_EQ(std::set<std::string>(names_.begin(), names_.end()).size(), names_.size());
  EXPECT_EQ(names_.size(),
            9U + 8 + 21 + 3 * (5 + 2 * 5) + 2 * (13 + 8) + 15 + 8 + (1 + 7 + 21 + 6 + 6 + 1 + 2));
}

TEST_F(CsvFile, ATickWithAPoseHasItsNumbers) {
  const Row row = this->row(1);
  EXPECT_EQ(row.at("tick"), "5");
  EXPECT_EQ(row.at("t_s"), "1.500000005");
  EXPECT_EQ(row.at("state"), "tracking");
  EXPECT_EQ(row.at("reason"), "none");
  EXPECT_EQ(row.at("x_m"), "1.25");
  EXPECT_EQ(row.at("qx"), "-0.5");
  EXPECT_EQ(row.at("qw"), "0.5");
  EXPECT_EQ(row.at("rms_residual_m"), "0.003");
  EXPECT_EQ(row.at("cameras_used"), "2");
  EXPECT_EQ(row.at("dots_used"), "2");
  EXPECT_DOUBLE_EQ(std::stod(row.at("cov_x_x")), 1e-6);
  EXPECT_DOUBLE_EQ(std::stod(row.at("cov_y_yaw")), 12e-6);
  EXPECT_DOUBLE_EQ(std::stod(row.at("cov_yaw_yaw")), 36e-6);
  EXPECT_EQ(row.at("dot_sigma_m"), "0.0002");
}

TEST_F(CsvFile, ADotHasItsPlaceInSpaceAndInTheImagesThatShowIt) {
  const Row row = this->row(1);
  EXPECT_EQ(row.at("dot0_located"), "1");
  EXPECT_EQ(row.at("dot0_z_m"), "0.3");
  EXPECT_EQ(row.at("dot0_sigma_m"), "0.004");
  EXPECT_EQ(row.at("dot0_left_x_px"), "");
  EXPECT_EQ(row.at("dot0_right_x_px"), "12.5");
  EXPECT_EQ(row.at("dot0_right_y_px"), "99.25");
  EXPECT_EQ(row.at("dot0_right_residual_px"), "0.125");
  EXPECT_EQ(row.at("dot2_located"), "0");
  EXPECT_EQ(row.at("dot2_x_m"), "");
}

TEST_F(CsvFile, CamerasAndAcquisitionAreThere) {
  const Row row = this->row(1);
  EXPECT_EQ(row.at("left_delivered"), "1");
  EXPECT_EQ(row.at("left_regions"), "7");
  EXPECT_EQ(row.at("left_components"), "19");
  EXPECT_EQ(row.at("left_rejected_size"), "8");
  EXPECT_EQ(row.at("left_rejected_shape"), "4");
  EXPECT_EQ(row.at("left_rejected_sight"), "2");
  EXPECT_EQ(row.at("left_sightings"), "5");
  EXPECT_EQ(row.at("right_delivered"), "0");
  EXPECT_EQ(row.at("right_overflow"), "1");
  EXPECT_EQ(row.at("left_moved"), "0");
  EXPECT_EQ(row.at("left_shift_x_px"), "0");
  EXPECT_EQ(row.at("rig_disagrees"), "0");
  EXPECT_EQ(row.at("pairs_tested"), "1234");
  EXPECT_EQ(row.at("acquisition_ticks"), "2");
  EXPECT_EQ(row.at("min_views"), "3");
  EXPECT_EQ(row.at("dots_matched"), "4");
  EXPECT_EQ(row.at("relock"), "better_elsewhere");
  EXPECT_EQ(row.at("candidate_false_lock_probability"), "0.25");
  EXPECT_EQ(row.at("false_lock_probability"), "0.125");
}

TEST_F(CsvFile, EachCamerasLightIsThere) {
  const Row row = this->row(1);
  EXPECT_EQ(row.at("left_peak_dn"), "180");
  EXPECT_EQ(row.at("left_light"), "steady");
  EXPECT_EQ(row.at("left_iris_condition"), "at_end");
  EXPECT_EQ(row.at("left_exposure_ms"), "2.5");
  EXPECT_EQ(row.at("left_gain"), "1.5");
  EXPECT_EQ(row.at("left_iris"), "0.75");
  EXPECT_EQ(row.at("right_light"), "off");
  EXPECT_EQ(row.at("right_iris_condition"), "automatic");
  EXPECT_EQ(row.at("right_exposure_ms"), "");
}

TEST_F(CsvFile, HowTheVehicleMovesIsThere) {
  EXPECT_EQ(row(1).at("vx_m_s"), "0.5");
  EXPECT_EQ(row(1).at("vy_m_s"), "-0.25");
  EXPECT_EQ(row(1).at("wz_rad_s"), "1.5");
  EXPECT_EQ(row(2).at("vx_m_s"), "");
  EXPECT_EQ(row(2).at("wz_rad_s"), "");
  EXPECT_EQ(row(2).at("false_lock_probability"), "");
}

TEST_F(CsvFile, ATickWithoutAPoseHasItsReasonAndEmptyFields) {
  const Row row = this->row(2);
  EXPECT_EQ(row.at("tick"), "6");
  EXPECT_EQ(row.at("state"), "acquiring");
  EXPECT_EQ(row.at("reason"), "too_few_regions");
  EXPECT_EQ(row.at("ticks_lost"), "3");
  EXPECT_EQ(row.at("x_m"), "");
  EXPECT_EQ(row.at("cov_yaw_yaw"), "");
  EXPECT_EQ(row.at("pairs_tested"), "0");
  EXPECT_EQ(row.at("relock"), "none");
}

}  // namespace
}  // namespace dottrack::telemetry
