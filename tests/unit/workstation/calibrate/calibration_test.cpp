#include "app/workstation/calibrate/fit/calibration.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "app/config/camera_file.h"
#include "app/config/camera_internal.h"
#include "tests/unit/workstation/calibrate/synthetic_hall.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

test::HallOptions small_hall(std::uint64_t seed) {
  test::HallOptions options;
  options.cameras = 4;
  options.seed = seed;
  return options;
}

CalibrationOptions quick(ModelKind kind = ModelKind::cahvor) {
  CalibrationOptions options;
  options.kind = kind;
  options.folds = 3;
  return options;
}

std::size_t seen_by_all(const test::Hall& hall) {
  std::vector<std::size_t> count(hall.dots.size(), 0);
  for (const CameraViews& v : hall.views) {
    for (const Observation& o : v.observations) ++count[o.dot];
  }
  const auto most = std::max_element(count.begin(), count.end());
  EXPECT_EQ(*most, hall.views.size());
  return static_cast<std::size_t>(most - count.begin());
}

// Everything that a calibration says of its cameras, to the last digit.
std::string text_of(const Calibration& calibration) {
  std::string text;
  for (const CameraCalibration& c : calibration.cameras) {
    config::CameraFile file;
    file.model = c.model;
    file.covariance = c.covariance;
    text += config::write_camera_text(file);
    for (const ResidualOfView& r : c.residuals) {
      text += std::to_string(r.holdout_px.x()) + (r.used ? " " : "!");
    }
  }
  return text;
}

TEST(Calibrate, FindsTheCamerasOfAHall) {
  const test::Hall hall = test::make_hall(small_hall(1));
  const auto found = calibrate(hall.dots, hall.views, quick());
  ASSERT_TRUE(found) << found.error().message;
  std::size_t count = 0;
  for (std::size_t i = 0; i < found->cameras.size(); ++i) {
    const CameraCalibration& c = found->cameras[i];
    EXPECT_LT(test::rms_on_unseen_px(hall, i, c.model, count), 0.1) << c.name;
    EXPECT_EQ(c.covariance.rows(), 18);
    EXPECT_GT(c.coverage, 0.3);
    EXPECT_NEAR(c.image_sigma_px, 0.05, 0.02);
    EXPECT_GT(c.holdout_rms_px, c.rms_px);
  }
  EXPECT_GT(count, 300U);
  EXPECT_TRUE(found->suspects.empty());
  EXPECT_NEAR(found->survey_scale, 1.0, 0.25);
  EXPECT_GT(found->holdout_dots, 30U);
  EXPECT_LT(found->holdout_rms_m, 0.004);
}

TEST(Calibrate, IsTheSameWithAnyNumberOfThreads) {
  const test::Hall hall = test::make_hall(small_hall(2));
  CalibrationOptions options = quick(ModelKind::automatic);
  options.threads = 1;
  const auto one = calibrate(hall.dots, hall.views, options);
  options.threads = 3;
  const auto three = calibrate(hall.dots, hall.views, options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(text_of(*one), text_of(*three));
}

TEST(Calibrate, LeavesOutAWrongViewAndNamesAWrongDot) {
  test::Hall hall = test::make_hall(small_hall(4));
  Observation& wrong = hall.views[0].observations[3];
  wrong.pixel += Vector2d(3.0, -4.0);
  const std::size_t wrong_dot = seen_by_all(hall);
  hall.dots[wrong_dot].position_m += Vector3d(0.0, 0.02, 0.01);
  const auto found = calibrate(hall.dots, hall.views, quick());
  ASSERT_TRUE(found);
  ASSERT_EQ(found->suspects.size(), 1U);
  EXPECT_EQ(found->suspects[0].name, hall.dots[wrong_dot].name);
  EXPECT_LT((found->suspects[0].off_m - Vector3d(0.0, -0.02, -0.01)).norm(), 0.005);
  EXPECT_GT(found->suspects[0].sigmas, 5.0);
  for (const CameraCalibration& c : found->cameras) {
    for (const ResidualOfView& r : c.residuals) {
      EXPECT_EQ(r.used, r.pixel != wrong.pixel) << c.name << " " << hall.dots[r.dot].name;
    }
  }
}

TEST(Calibrate, DoesNotOverfitALongLens) {
  test::HallOptions options = small_hall(5);
  options.focal_px = 4000.0;
  options.extent = 0.1;
  options.survey_sigma_m = 0.0001;
  options.radial.setZero();
  options.dots = 120;
  options.aspect = 0.0;
  options.axis = 0.0;
  const test::Hall hall = test::make_hall(options);
  const auto found = calibrate(hall.dots, hall.views, quick(ModelKind::automatic));
  ASSERT_TRUE(found) << found.error().message;
  int pinholes = 0;
  for (const CameraCalibration& c : found->cameras) {
    pinholes += c.chosen == ModelKind::cahv ? 1 : 0;
    EXPECT_LT(c.holdout_rms_px, 2.0 * c.rms_px);
    EXPECT_GE(c.tried.size(), 3U);
  }
  EXPECT_GE(pinholes, 3);
}

TEST(Calibrate, ChoosesDistortionWhereThereIsSome) {
  test::HallOptions options = small_hall(6);
  options.axis = 0.0;
  options.radial = {-0.2, 0.05};
  options.survey_sigma_m = 0.0002;
  const test::Hall hall = test::make_hall(options);
  const auto found = calibrate(hall.dots, hall.views, quick(ModelKind::automatic));
  ASSERT_TRUE(found) << found.error().message;
  for (const CameraCalibration& c : found->cameras) {
    EXPECT_NE(c.chosen, ModelKind::cahv) << c.name;
    EXPECT_EQ(std::count_if(c.tried.begin(), c.tried.end(), [](auto& t) { return t.chosen; }), 1);
  }
}

TEST(Calibrate, ManagesOneCameraAlone) {
  test::HallOptions options = small_hall(7);
  options.cameras = 1;
  const test::Hall hall = test::make_hall(options);
  const auto found = calibrate(hall.dots, hall.views, quick(ModelKind::automatic));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->holdout_dots, 0U);
  EXPECT_TRUE(found->suspects.empty());
  EXPECT_GT(found->cameras[0].sigmas.place_m, 1e-4);
}

TEST(Calibrate, LearnsASurveyThatIsBetterThanClaimed) {
  test::HallOptions options = small_hall(8);
  options.survey_sigma_m = 0.0001;
  const test::Hall hall = test::make_hall(options);
  const auto found = calibrate(hall.dots, hall.views, quick());
  ASSERT_TRUE(found);
  EXPECT_LT(found->survey_scale, 0.4);
}

// Floor dots alone, cameras that look down on them at a slant.
TEST(Calibrate, HoldsWhatAPlaneDoesNotTell) {
  test::HallOptions options = small_hall(9);
  options.radial.setZero();
  options.aspect = 0.0;
  test::Hall hall = test::make_hall(options);
  std::vector<bool> floor;
  for (const Vector3d& p : hall.places_m) floor.push_back(p.z() == 0.0);
  for (std::size_t j = 0; j < floor.size(); ++j) {
    if (floor[j]) hall.dots[j].position_m.z() = 0.0;
  }
  for (CameraViews& v : hall.views) {
    std::erase_if(v.observations, [&](const Observation& o) { return !floor[o.dot]; });
  }
  const auto found = calibrate(hall.dots, hall.views, quick(ModelKind::cahv));
  ASSERT_TRUE(found) << found.error().message;
  for (std::size_t i = 0; i < found->cameras.size(); ++i) {
    const config::InternalModel internal = [&] {
      const geometry::Cahv m = config::linear_part(found->cameras[i].model);
      return config::internal_model(m.a, m.h, m.v);
    }();
    EXPECT_NEAR(internal.hc, 319.5, 40.0);
    EXPECT_NEAR(internal.vs / internal.hs, 1.0, 0.01);
  }
}

// A wall full of dots, and cameras that look at it: the second one tilted by an angle.
struct Wall {
  std::vector<SurveyedDot> dots;
  std::vector<CameraViews> views;
  std::vector<geometry::Cahv> truths;
};

Wall wall(double tilt_rad) {
  Wall out;
  for (int i = 0; i < 48; ++i) {
    SurveyedDot& dot = out.dots.emplace_back();
    dot.name = std::to_string(i + 1);
    dot.position_m = {0.4 * (i % 8) - 1.4, 0.4 * (i / 8) - 1.0, 0.0};
    dot.sigma_m = Vector3d::Constant(1e-4);
  }
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.05);
  for (const double tilt : {0.6, tilt_rad}) {
    const Vector3d a(std::sin(tilt), 0.0, std::cos(tilt));
    const Vector3d right(std::cos(tilt), 0.0, -std::sin(tilt));
    const Vector3d down(0.0, 1.0, 0.0);
    const geometry::Cahv truth{-4.0 * a, a, 600.0 * right + 319.5 * a, 600.0 * down + 239.5 * a};
    CameraViews& views = out.views.emplace_back();
    views.name = "cam" + std::to_string(out.views.size());
    views.width_px = test::kHallColumns;
    views.height_px = test::kHallRows;
    for (std::size_t j = 0; j < out.dots.size(); ++j) {
      Vector2d pixel;
      EXPECT_EQ(project(truth, out.dots[j].position_m, pixel), geometry::OpticsStatus::ok);
      views.observations.push_back({j, pixel + Vector2d(noise(random), noise(random)), 0.05});
    }
    out.truths.push_back(truth);
  }
  return out;
}

TEST(Calibrate, SaysWhichCameraLooksStraightAtAPlane) {
  for (const double tilt : {0.0, 0.001}) {
    const Wall given = wall(tilt);
    const auto found = calibrate(given.dots, given.views, quick(ModelKind::cahv));
    ASSERT_FALSE(found) << tilt;
    const std::string& message = found.error().message;
    EXPECT_NE(message.find("camera cam2"), std::string::npos) << message;
    EXPECT_NE(message.find("48 dots are in one plane"), std::string::npos) << message;
    EXPECT_NE(message.find("tilt it"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Calibrate, TakesTheFocalLengthOfAModelWhereAPlaneDoesNotTell) {
  Wall given = wall(0.0);
  given.views[1].approximate = given.truths[1];
  const auto found = calibrate(given.dots, given.views, quick(ModelKind::cahv));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT((geometry::centre(found->cameras[1].model) - given.truths[1].c).norm(), 0.02);
  const auto& remarks = found->cameras[1].remarks;
  EXPECT_EQ(std::count_if(remarks.begin(), remarks.end(),
                          [](auto& r) { return r.find("focal length held") != r.npos; }),
            1);
}

TEST(Calibrate, MeasuresAFocalLengthFromATiltedPlane) {
  const Wall given = wall(0.35);
  const auto found = calibrate(given.dots, given.views, quick(ModelKind::cahv));
  ASSERT_TRUE(found) << found.error().message;
  for (std::size_t i = 0; i < found->cameras.size(); ++i) {
    EXPECT_LT((geometry::centre(found->cameras[i].model) - given.truths[i].c).norm(), 0.02);
  }
}

TEST(Calibrate, SaysWhichCameraSeesTooLittle) {
  test::Hall hall = test::make_hall(small_hall(10));
  hall.views[2].observations.resize(5);
  const auto found = calibrate(hall.dots, hall.views, quick());
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("cam3"), std::string::npos);
  EXPECT_NE(found.error().message.find("5 dots"), std::string::npos);
}

TEST(Calibrate, RefusesAMirroredWorld) {
  test::Hall hall = test::make_hall(small_hall(11));
  test::Hall one = hall;
  for (SurveyedDot& dot : hall.dots) dot.position_m.y() *= -1.0;
  const auto found = calibrate(hall.dots, hall.views, quick());
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("left-handed"), std::string::npos);
  for (Observation& o : one.views[1].observations) o.pixel.x() = 639.0 - o.pixel.x();
  const auto other = calibrate(one.dots, one.views, quick());
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("cam2"), std::string::npos);
  EXPECT_NE(other.error().message.find("mirrored"), std::string::npos);
}

TEST(Calibrate, StopsWhenAsked) {
  const test::Hall hall = test::make_hall(small_hall(12));
  CalibrationOptions options = quick();
  int calls = 0;
  double last = 0.0;
  options.progress = [&](double part, const std::string&) {
    EXPECT_GE(part, last);
    last = part;
    return ++calls < 2;
  };
  const auto found = calibrate(hall.dots, hall.views, options);
  ASSERT_FALSE(found);
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace dottrack::calibrate
