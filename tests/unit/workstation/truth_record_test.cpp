#include "app/workstation/truth_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"

namespace dottrack::workstation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

core::Pose pose(double x_m, double yaw_deg) {
  core::Pose pose;
  pose.position_m = {x_m, 0.0, 0.0};
  pose.orientation = Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
  pose.covariance.diagonal() << 1e-6, 4e-6, 9e-6, 1e-4, 1e-4, 4e-4;
  return pose;
}

telemetry::CycleRecord record(std::uint64_t tick, double time_s, bool has_pose, double x_m) {
  telemetry::CycleRecord record;
  record.stamp = Time(Duration(std::llround(1e9 * time_s)));
  record.result.tick = tick;
  record.result.has_pose = has_pose;
  record.result.pose = pose(x_m, 0.0);
  record.result.dots_used = 4;
  record.result.cameras_used = CameraSet(0b111);
  return record;
}

TEST(PoseErrorTest, IsReportedMinusTrue) {
  const PoseError error =
      error_of(pose(0.003, 2.0), {{0.0, 0.004, 0.0}, Eigen::Quaterniond(1, 0, 0, 0)});
  EXPECT_NEAR(error.position_m.x(), 0.003, 1e-12);
  EXPECT_NEAR(error.position_m.y(), -0.004, 1e-12);
  EXPECT_NEAR(error.position_mm(), 5.0, 1e-9);
  EXPECT_NEAR(error.rotation_rad.z(), 2.0 * kDegree, 1e-12);
  EXPECT_NEAR(error.attitude_deg(), 2.0, 1e-9);
  // (3 mm / 1 mm)^2 + (4 mm / 2 mm)^2 + (2 degrees / 0.02)^2
  const double expected = 9.0 + 4.0 + std::pow(2.0 * kDegree / 0.02, 2);
  EXPECT_NEAR(error.nees, expected, 1e-9);
}

// q and -q are the same attitude.
TEST(PoseErrorTest, DoesNotDependOnTheQuaternionsSign) {
  TruePose truth{Eigen::Vector3d::Zero(), pose(0.0, 1.0).orientation};
  truth.orientation.coeffs() = -truth.orientation.coeffs();
  EXPECT_NEAR(error_of(pose(0.0, 2.0), truth).attitude_deg(), 1.0, 1e-9);
}

TEST(PoseErrorTest, ACovarianceThatIsNoneHasNoNormalisedError) {
  core::Pose bad = pose(0.0, 0.0);
  bad.covariance(0, 0) = 0.0;
  EXPECT_TRUE(std::isnan(error_of(bad, {}).nees));
}

TEST(PoseErrorTest, FarOffIsAWrongLock) {
  EXPECT_FALSE(error_of(pose(0.099, 0.0), {}).wrong_lock());
  EXPECT_TRUE(error_of(pose(0.101, 0.0), {}).wrong_lock());
  EXPECT_FALSE(error_of(pose(0.0, 4.9), {}).wrong_lock());
  EXPECT_TRUE(error_of(pose(0.0, 5.1), {}).wrong_lock());
  EXPECT_TRUE(error_of(pose(std::nan(""), 0.0), {}).wrong_lock());
}

TEST(TruthRecordTest, KeepsARowATickAndWritesTheTruth) {
  const test::TemporaryFolder folder;
  auto file = telemetry::OutputFile::create(folder.path() / "truth.tum");
  ASSERT_TRUE(file);
  // The vehicle is there in the first half second only.
  TruthRecord truth(*file, [](Time time) -> std::optional<TruePose> {
    if (time.time_since_epoch() > std::chrono::milliseconds(500)) return std::nullopt;
    return TruePose{{1.0, 0.0, 0.0}, Eigen::Quaterniond(1, 0, 0, 0)};
  });
  truth.write(record(0, 0.0, false, 0.0));
  truth.write(record(1, 0.25, true, 1.003));
  truth.write(record(2, 0.5, true, 1.004));
  truth.write(record(3, 0.75, true, 1.0));  // of a vehicle that is not there
  truth.write(record(4, 1.0, false, 0.0));
  ASSERT_TRUE(file->finish());
  ASSERT_EQ(truth.rows().size(), 5U);
  EXPECT_FALSE(truth.rows()[0].wrong_lock());
  EXPECT_FALSE(truth.rows()[1].wrong_lock());
  EXPECT_TRUE(truth.rows()[3].wrong_lock());
  EXPECT_EQ(truth.rows()[1].cameras_used, 3);
  const auto lines = lines_of(folder.path() / "truth.tum");
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1],
            "0.250000000 1.000000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000");

  const Accuracy accuracy = accuracy_of(truth.rows());
  EXPECT_EQ(accuracy.compared, 2U);
  EXPECT_EQ(accuracy.wrong_lock_ticks, 1U);
  EXPECT_NEAR(accuracy.position_rms_mm, std::sqrt((9.0 + 16.0) / 2.0), 1e-9);
  EXPECT_NEAR(accuracy.position_max_mm, 4.0, 1e-9);
  EXPECT_NEAR(accuracy.nees_mean, (9.0 + 16.0) / 2.0, 1e-6);
}

TEST(AccuracyTest, OfNothingIsZero) {
  const Accuracy accuracy = accuracy_of({});
  EXPECT_EQ(accuracy.compared, 0U);
  EXPECT_EQ(accuracy.wrong_lock_ticks, 0U);
  EXPECT_EQ(accuracy.nees_mean, 0.0);
}

}  // namespace
}  // namespace dottrack::workstation
