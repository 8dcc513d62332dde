// From surveyed dots to poses: cameras calibrated in twenty halls, and whether the poses that they
// give are as good as their covariances say.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "app/config/rig_file.h"
#include "app/core/estimation/pose_fit.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/report/error_map.h"
#include "app/workstation/calibrate/report/rig_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/workstation/calibrate/synthetic_hall.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using estimation::DotObservations;

constexpr std::uint64_t kHalls = 20;
constexpr int kPoses = 20;  // in each
constexpr double kNoise_px = 0.02;

constexpr const char* kTarget =
    "dot,x_m,y_m,z_m,diameter_m\n1,0.45,0.30,0.0,0.1\n2,-0.50,0.25,0.0,0.1\n"
    "3,-0.35,-0.33,0.05,0.1\n4,0.30,-0.20,0.0,0.1\n5,0.05,0.42,0.1,0.1\n";

std::unique_ptr<core::Rig> rig_of(const Calibration& calibration) {
  const test::TemporaryFolder folder;
  const auto target = folder.write("given.csv", kTarget);
  const auto files = rig_files(calibration, {.name = "hall", .target = target});
  if (!files) throw std::runtime_error(files.error().message);
  for (const RigFile& file : *files) folder.write(file.name, file.text);
  const auto config =
      config::load_rig(folder.path() / "rig.toml", config::Targets::taken_as_they_are);
  if (!config) throw std::runtime_error(config.error().message);
  return std::make_unique<core::Rig>(config->rig);
}

struct CalibratedHall {
  test::Hall hall;
  Calibration calibration;
};

class CalibratedPose : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    CalibrationOptions how;
    how.kind = ModelKind::cahvor;
    how.folds = 2;
    test::HallOptions options;
    for (options.seed = 1; options.seed <= kHalls; ++options.seed) {
      test::Hall hall = test::make_hall(options);
      auto calibration = calibrate(hall.dots, hall.views, how);
      if (!calibration) throw std::runtime_error(calibration.error().message);
      halls_.push_back({std::move(hall), std::move(*calibration)});
    }
  }
  static void TearDownTestSuite() { halls_.clear(); }

  // Among the places of the hall that no dot is at.
  geometry::RigidMotion somewhere(const test::Hall& hall) {
    std::uniform_int_distribution<std::size_t> which(0, hall.unseen_m.size() - 1);
    std::uniform_real_distribution<double> heading(-3.14, 3.14);
    geometry::RigidMotion pose;
    pose.translation_m = hall.unseen_m[which(random_)];
    pose.rotation = Eigen::AngleAxisd(heading(random_), Vector3d::UnitZ());
    return pose;
  }

  DotObservations see(const test::Hall& hall, const core::Rig& rig,
                      const geometry::RigidMotion& pose) {
    std::normal_distribution<double> noise(0.0, kNoise_px);
    DotObservations views;
    for (std::size_t camera = 0; camera < hall.truths.size(); ++camera) {
      for (std::size_t dot = 0; dot < rig.target.dots.size(); ++dot) {
        Vector2d pixel;
        const Vector3d place = pose * rig.target.dots[dot].position_m;
        if (geometry::project(hall.truths[camera], place, pixel) != geometry::OpticsStatus::ok) {
          continue;
        }
        if (pixel.minCoeff() < 0.0 || pixel.x() > test::kHallColumns - 1 ||
            pixel.y() > test::kHallRows - 1) {
          continue;
        }
        pixel += Vector2d(noise(random_), noise(random_));
        views.push_back({static_cast<std::uint8_t>(camera), static_cast<std::uint8_t>(dot), pixel,
                         kNoise_px * kNoise_px * Eigen::Matrix2d::Identity()});
      }
    }
    return views;
  }

  struct SeenPlace {
    const CameraCalibration* camera;
    Vector2d pixel;
    Eigen::Matrix2d weight;
  };

  // A place as noisy as the calibration's dots were.
  std::vector<SeenPlace> look(const test::Hall& hall, const Calibration& calibration,
                              const Vector3d& place) {
    std::normal_distribution<double> noise(0.0, test::HallOptions().image_sigma_px);
    std::vector<SeenPlace> views;
    for (std::size_t i = 0; i < hall.truths.size(); ++i) {
      const CameraCalibration& camera = calibration.cameras[i];
      Vector2d pixel;
      geometry::ProjectionJacobian by_point;
      Eigen::Matrix2d covariance;
      if (!model_covariance(camera, place, covariance, by_point)) continue;
      if (project(hall.truths[i], place, pixel) != geometry::OpticsStatus::ok) continue;
      pixel += Vector2d(noise(random_), noise(random_));
      covariance.diagonal().array() += camera.image_sigma_px * camera.image_sigma_px;
      views.push_back({&camera, pixel, covariance.inverse()});
    }
    return views;
  }

  // Least squares from the place itself.
  static Vector3d triangulated(const std::vector<SeenPlace>& views, Vector3d place) {
    for (int step = 0; step < 4; ++step) {
      Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
      Vector3d pull = Vector3d::Zero();
      for (const SeenPlace& view : views) {
        Vector2d shown;
        geometry::ProjectionJacobian by_point;
        EXPECT_EQ(project(view.camera->model, place, shown, &by_point), geometry::OpticsStatus::ok);
        information += by_point.transpose() * view.weight * by_point;
        pull += by_point.transpose() * view.weight * (view.pixel - shown);
      }
      place += information.inverse() * pull;
    }
    return place;
  }

  static double normalised_square(const core::Rig& rig, const DotObservations& views,
                                  const geometry::RigidMotion& truth) {
    estimation::PoseFitter fitter(rig);
    estimation::PoseFit fit;
    EXPECT_EQ(fitter.fit(as_span(views), {}, truth, estimation::DotSpread::none(), fit),
              estimation::PoseFitStatus::ok);
    const Eigen::AngleAxisd turn(fit.pose.orientation * truth.rotation.conjugate());
    estimation::Vector6d error;
    error << fit.pose.position_m - truth.translation_m, turn.angle() * turn.axis();
    return error.dot(fit.pose.covariance.inverse() * error);
  }

  static std::vector<CalibratedHall> halls_;
  std::mt19937 random_{17};
};

std::vector<CalibratedHall> CalibratedPose::halls_;

// Places triangulated by the calibrated models, against the report's map.
TEST_F(CalibratedPose, TheReportsMapIsTrue) {
  double sum = 0.0;  // of squared errors over the expected ones
  int places = 0;
  for (const auto& [hall, calibration] : halls_) {
    const ErrorMap map = error_map(calibration, hall.dots, 0.4);
    for (std::size_t row = 2; row < map.rows; row += 5) {
      for (std::size_t column = 2; column < map.columns; column += 5) {
        const double expected_m = map.error_m[row * map.columns + column];
        if (map.cameras[row * map.columns + column] < 3) continue;
        const Vector3d place = map.middle(column, row);
        const Vector3d found = triangulated(look(hall, calibration, place), place);
        sum += (found - place).squaredNorm() / (expected_m * expected_m);
        ++places;
      }
    }
  }
  RecordProperty("ratio", std::to_string(sum / places));
  EXPECT_GT(places, 200);
  EXPECT_GT(sum / places, 0.7);
  EXPECT_LT(sum / places, 1.3);
}

// Poses of one hall share its calibration's errors: the mean over halls is known to about 1.
TEST_F(CalibratedPose, IsAsGoodAsItsCovarianceSays) {
  double sum = 0.0;
  double without = 0.0;
  int poses = 0;
  for (const auto& [hall, calibration] : halls_) {
    const auto rig = rig_of(calibration);
    ASSERT_TRUE(rig->model_correlations.known());
    core::Rig apart = *rig;
    apart.model_correlations = {};
    for (int i = 0; i < kPoses; ++i) {
      const geometry::RigidMotion truth = somewhere(hall);
      const DotObservations views = see(hall, *rig, truth);
      if (views.size() < 15) continue;
      sum += normalised_square(*rig, views, truth);
      without += normalised_square(apart, views, truth);
      ++poses;
    }
  }
  RecordProperty("mean", std::to_string(sum / poses));
  RecordProperty("mean_without", std::to_string(without / poses));
  EXPECT_GT(poses, 300);
  EXPECT_GT(sum / poses, 4.5);
  EXPECT_LT(sum / poses, 7.5);
  EXPECT_GT(without / poses, 1.3 * sum / poses);
}

}  // namespace
}  // namespace dottrack::calibrate
