// Trajectories read from files and compared with the truth.

#include "app/workstation/accuracy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/workstation/tum_reader.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;

TimedPose at(double time_s, double x_m, double yaw_deg) {
  const double yaw_rad = yaw_deg * std::numbers::pi / 180.0;
  return {time_s,
          {x_m, 0.0, 0.0},
          Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()))};
}

TEST(AccuracyTest, IsTheRootMeanSquareAndTheMaximum) {
  const std::vector<TimedPose> truth = {at(0.0, 1.0, 0.0), at(0.1, 2.0, 0.0), at(0.2, 3.0, 0.0)};
  const std::vector<TimedPose> poses = {at(0.0, 1.003, 0.3), at(0.2, 3.004, -0.4)};
  const Accuracy accuracy = compare(poses, truth);
  EXPECT_EQ(accuracy.compared, 2U);
  EXPECT_EQ(accuracy.without_truth, 0U);
  EXPECT_EQ(accuracy.wrong_lock_ticks, 0U);
  EXPECT_NEAR(accuracy.position_rms_mm, std::sqrt((9.0 + 16.0) / 2.0), 1e-9);
  EXPECT_NEAR(accuracy.position_max_mm, 4.0, 1e-9);
  EXPECT_NEAR(accuracy.attitude_rms_deg, std::sqrt((0.09 + 0.16) / 2.0), 1e-9);
  EXPECT_NEAR(accuracy.attitude_max_deg, 0.4, 1e-9);
}

TEST(AccuracyTest, FarOffIsAWrongLock) {
  const std::vector<TimedPose> truth = {at(0.0, 0.0, 0.0), at(0.1, 0.0, 0.0), at(0.2, 0.0, 0.0)};
  const std::vector<TimedPose> poses = {at(0.0, 0.101, 0.0), at(0.1, 0.0, 5.1), at(0.2, 0.09, 4.9)};
  EXPECT_EQ(compare(poses, truth).wrong_lock_ticks, 2U);
}

TEST(AccuracyTest, APoseAtAnotherTimeHasNoTruth) {
  const std::vector<TimedPose> truth = {at(0.0, 0.0, 0.0), at(0.1, 0.0, 0.0)};
  const std::vector<TimedPose> poses = {at(0.0005, 0.0, 0.0), at(0.05, 0.0, 0.0),
                                        at(0.5, 0.0, 0.0)};
  const Accuracy accuracy = compare(poses, truth);
  EXPECT_EQ(accuracy.compared, 1U);
  EXPECT_EQ(accuracy.without_truth, 2U);
}

TEST(AccuracyTest, NoPosesHaveNoErrors) {
  const Accuracy accuracy = compare({}, std::vector<TimedPose>{at(0.0, 0.0, 0.0)});
  EXPECT_EQ(accuracy.compared, 0U);
  EXPECT_EQ(accuracy.position_rms_mm, 0.0);
}

TEST(TumReaderTest, ReadsPosesAndSkipsComments) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("a.tum", "# t x y z q\n0 1 2 3 0 0 0 1\n\n0.5 4 5 6 0 0 1 0\n");
  const auto poses = read_tum(file);
  ASSERT_TRUE(poses) << poses.error().message;
  ASSERT_EQ(poses->size(), 2U);
  EXPECT_EQ((*poses)[1].time_s, 0.5);
  EXPECT_EQ((*poses)[1].position_m, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ((*poses)[1].orientation.z(), 1.0);
}

TEST(TumReaderTest, RefusesWhatIsNoPoseAndNamesTheLine) {
  const test::TemporaryFolder folder;
  for (const char* line : {"1 1 2 3 0 0 0", "1 1 2 3 0 0 0 1 9", "1 a 2 3 0 0 0 1",
                           "1 1 2 3 0 0 0 0.9", "1 nan 2 3 0 0 0 1", "0 1 2 3 0 0 0 1"}) {
    const auto file = folder.write("a.tum", "0 1 2 3 0 0 0 1\n" + std::string(line) + "\n");
    const auto poses = read_tum(file);
    ASSERT_FALSE(poses) << line;
    EXPECT_THAT(poses.error().message, HasSubstr("a.tum:2: expected")) << line;
  }
  EXPECT_FALSE(read_tum(folder.path() / "absent.tum"));
}

}  // namespace
}  // namespace dottrack::workstation
