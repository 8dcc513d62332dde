// A camera that was knocked against, from a drive that the others tracked.

#include "app/workstation/calibrate/repair/camera_repair.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "host_sim/scenarios/scene.h"
#include "tests/unit/workstation/survey/recorded_drive.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kCamera = 2;

host_sim::SimCamera knocked(const host_sim::SimCamera& camera, double degrees, double shift_m,
                            std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Vector3d axis = Vector3d{normal(random), normal(random), normal(random)}.normalized();
  const Vector3d way = Vector3d{normal(random), normal(random), normal(random)}.normalized();
  return host_sim::moved(camera, {kCamera, 0.0, degrees * M_PI / 180.0 * axis, shift_m * way});
}

// RMS over places that the drive went through and more, between the model and the truth.
double unseen_error_px(const geometry::CameraModel& model, const host_sim::SimCamera& truth,
                       int& places) {
  double sum2 = 0.0;
  places = 0;
  for (double x = -9.0; x <= 9.0; x += 0.5) {
    for (double y = -3.5; y <= 3.5; y += 0.5) {
      const Vector3d p(x, y, 0.8);
      const auto pixel = truth.project(p);
      Vector2d told;
      if (!pixel || pixel->x() < 0 || pixel->y() < 0 || pixel->x() > 639 || pixel->y() > 479 ||
          geometry::project(model, p, told) != geometry::OpticsStatus::ok) {
        continue;
      }
      sum2 += (told - *pixel).squaredNorm() / 2.0;
      ++places;
    }
  }
  return std::sqrt(sum2 / std::max(places, 1));
}

struct Knock {
  double degrees;
  double shift_m;
};

class CameraRepairTest : public testing::TestWithParam<Knock> {};

TEST_P(CameraRepairTest, FindsTheCameraAgain) {
  const auto [degrees, shift_m] = GetParam();
  test::RecordedDrive drive;
  const host_sim::SimCamera truth = knocked(drive.camera(kCamera), degrees, shift_m, 5);
  drive.move_camera(kCamera, truth);
  const auto repair = repair_camera(drive.rig, kCamera, drive.drive({.seed = 6}), std::nullopt);
  ASSERT_TRUE(repair) << repair.error().message;
  EXPECT_GT(repair->views, 200U);
  int places = 0;
  EXPECT_LT(unseen_error_px(repair->model, truth, places), 0.05);
  EXPECT_GT(places, 50);
  EXPECT_NEAR(repair->turn_rad.norm() * 180.0 / M_PI, degrees, 0.02);
  EXPECT_NEAR(repair->shift_m.norm(), shift_m, 0.003);
  EXPECT_LT(repair->rms_px, 0.1);
  EXPECT_GT(repair->rms_before_px, repair->rms_px);
}

INSTANTIATE_TEST_SUITE_P(Knocks, CameraRepairTest,
                         testing::Values(Knock{0.05, 0.0}, Knock{0.2, 0.005}, Knock{2.0, 0.02}));

// Of position and attitude, in the vectors of the model: C is position itself.
TEST(CameraRepair, ItsUncertaintyIsTrue) {
  constexpr int kDrives = 20;
  double sum = 0.0;
  for (int k = 0; k < kDrives; ++k) {
    const auto seed = static_cast<std::uint64_t>(k + 1);
    test::RecordedDrive drive(seed);
    const host_sim::SimCamera truth = knocked(drive.camera(kCamera), 0.3, 0.01, seed);
    drive.move_camera(kCamera, truth);
    const auto repair = repair_camera(drive.rig, kCamera,
                                      drive.drive({.ticks = 150, .seed = 40 + seed}), std::nullopt);
    ASSERT_TRUE(repair) << repair.error().message;
    const Vector3d error = geometry::centre(repair->model) - truth.centre_m();
    const Eigen::Matrix3d covariance = repair->covariance.topLeftCorner<3, 3>();
    sum += error.dot(covariance.inverse() * error);
  }
  // 60 degrees of freedom: 1 +- 0.18.
  EXPECT_LT(sum / (3 * kDrives), 1.5);
  EXPECT_GT(sum / (3 * kDrives), 0.4);
}

TEST(CameraRepair, KeepsWhatWasKnownOfTheLens) {
  test::RecordedDrive drive;
  drive.move_camera(kCamera, knocked(drive.camera(kCamera), 0.3, 0.01, 2));
  const auto ticks = drive.drive({.ticks = 100});
  Eigen::MatrixXd before = Eigen::MatrixXd::Zero(18, 18);
  before(15, 15) = 1e-6;  // r0
  before(16, 16) = 1e-6;  // r1
  const auto with = repair_camera(drive.rig, kCamera, ticks, before);
  const auto without = repair_camera(drive.rig, kCamera, ticks, std::nullopt);
  ASSERT_TRUE(with && without);
  EXPECT_NEAR(with->covariance(16, 16), 1e-6, 1e-9);
  EXPECT_EQ(without->covariance(16, 16), 0.0);
  // A wrong lens turns the pose along.
  const auto place_variance = [](const CameraRepair& repair) {
    return Eigen::Matrix3d(repair.covariance.topLeftCorner<3, 3>()).trace();
  };
  EXPECT_GT(place_variance(*with), place_variance(*without));
}

TEST(CameraRepair, SaysWhatItHasTooLittleOf) {
  test::RecordedDrive drive;
  const auto none = repair_camera(drive.rig, kCamera, drive.drive({.ticks = 50}), std::nullopt);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message,
            "0 views of dots in 0 ticks while it was left out; expected 30 in 10 or more, in "
            "different places");
  drive.move_camera(kCamera, knocked(drive.camera(kCamera), 0.3, 0.01, 2));
  auto standing = drive.drive({.ticks = 100});
  std::vector<workstation::RecordedTick> same;
  for (const auto& tick : standing) {
    const auto seen = std::count_if(tick.views.begin(), tick.views.end(),
                                    [](const auto& v) { return v.camera == kCamera; });
    if (seen < 2) continue;
    same.assign(30, tick);
    for (auto& t : same) std::erase_if(t.views, [](const auto& v) { return v.dot > 1; });
    break;
  }
  const auto still = repair_camera(drive.rig, kCamera, same, std::nullopt);
  EXPECT_FALSE(still);
}

TEST(CameraRepair, CarriesEveryPartOfAModel) {
  const test::RecordedDrive drive;
  const geometry::CameraModel& model = drive.rig.cameras[0].model;
  const Vector3d turn(0.01, -0.02, 0.03);
  const Vector3d shift(0.1, 0.2, -0.3);
  const geometry::CameraModel moved = carried(model, turn, shift);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  const Vector3d p = geometry::centre(model) + Vector3d(1.0, -2.0, -4.0);
  const Vector3d q = geometry::centre(moved) + rotation * Vector3d(1.0, -2.0, -4.0);
  Vector2d before;
  Vector2d after;
  ASSERT_EQ(geometry::project(model, p, before), geometry::OpticsStatus::ok);
  ASSERT_EQ(geometry::project(moved, q, after), geometry::OpticsStatus::ok);
  EXPECT_LT((before - after).norm(), 1e-9);
}

}  // namespace
}  // namespace dottrack::calibrate
