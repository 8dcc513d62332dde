// Calibrated cameras are off as the theory of least squares says, and for its reasons.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "host_sim/renderer/normal_deviates.h"
#include "host_sim/survey/calibration.h"
#include "host_sim/survey/camera_fit.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Twelve under the ceiling of a hall of 22 x 9 m, along its two long walls.
std::vector<SimCamera> ceiling(LensKind kind) {
  std::vector<SimCamera> cameras;
  RandomStream random(3, 1);
  for (int i = 0; i < 12; ++i) {
    Lens lens;
    lens.kind = kind;
    const bool bent = kind == LensKind::fisheye;
    lens.focal_x_px = (bent ? 230.0 : 460.0) * random.uniform(0.9, 1.2);
    lens.focal_y_px = lens.focal_x_px * random.uniform(0.99, 1.01);
    lens.centre_x_px += random.uniform(-8.0, 8.0);
    lens.axis = {random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), 1.0};
    lens.radial = {0.0, bent ? -0.02 : random.uniform(-0.2, -0.1), bent ? 0.001 : 0.03};
    lens.pupil_m = {0.002, 0.0, 0.0};
    const Vector3d eye(-9.0 + 3.6 * (i % 6), i < 6 ? -4.0 : 4.0, 5.0);
    const Vector3d aim(0.6 * eye.x() + random.uniform(-1.0, 1.0), -0.3 * eye.y(), 0.0);
    cameras.emplace_back(eye, looking_at(eye, aim, random.uniform(-0.1, 0.1)), lens, 640, 480);
  }
  return cameras;
}

std::vector<Vector3d> hall_dots() {
  return calibration_dots(22.0, 9.0, 3.0, 600, 1);
}

bool in_picture(const Vector2d& pixel) {
  return pixel.x() > -0.5 && pixel.x() < 639.5 && pixel.y() > -0.5 && pixel.y() < 479.5;
}

// Root mean square distance between the pixels of a place in the hall, seen by both.
double rms_px(const std::vector<SimCamera>& truths, const std::vector<SimCamera>& others) {
  RandomStream random(4, 4);
  double squares = 0.0;
  int seen = 0;
  for (std::size_t c = 0; c < truths.size(); ++c) {
    for (int i = 0; i < 500; ++i) {
      const Vector3d p{random.uniform(-11.0, 11.0), random.uniform(-4.5, 4.5),
                       random.uniform(0.0, 2.0)};
      const auto pixel = truths[c].project(p);
      if (!pixel || !in_picture(*pixel)) continue;
      const auto other = others[c].project(p);
      EXPECT_TRUE(other);
      squares += other ? (*pixel - *other).squaredNorm() : 1e6;
      ++seen;
    }
  }
  EXPECT_GE(seen, 200);
  return std::sqrt(squares / seen);
}

std::vector<SimCamera> calibrate(const std::vector<SimCamera>& truths,
                                 const CalibrationOptions& options) {
  auto cameras = calibrated(truths, hall_dots(), options);
  EXPECT_TRUE(cameras) << cameras.error().message;
  return cameras ? *cameras : truths;
}

TEST(SurveyTest, WithoutErrorsTheTruthComesBack) {
  for (const LensKind kind : {LensKind::pinhole, LensKind::radial, LensKind::fisheye}) {
    const auto truths = ceiling(kind);
    const auto cameras = calibrate(truths, {.survey_sigma_m = 0.0, .image_sigma_px = 0.0});
    EXPECT_LT(rms_px(truths, cameras), 1e-6);
    for (std::size_t i = 0; i < truths.size(); ++i) {
      EXPECT_LT((truths[i].centre_m() - cameras[i].centre_m()).norm(), 1e-8);
    }
  }
}

// Least squares: what is left over is that of 2 N - n numbers, and the fit itself is off at its own
// dots as n numbers are, whatever the geometry.
TEST(SurveyTest, TheFitIsOffAsLeastSquaresSays) {
  constexpr double kSigma_px = 0.05;
  for (const LensKind kind : {LensKind::pinhole, LensKind::radial}) {
    double left_over = 0.0;
    double expected_left_over = 0.0;
    double off = 0.0;
    int fits = 0;
    RandomStream random(8, 8);
    const auto noise = [&] {
      return static_cast<double>(normal_deviates()[random.word() & 0xFFFFU]);
    };
    for (int repeat = 0; repeat < 8; ++repeat) {
      for (const SimCamera& truth : ceiling(kind)) {
        std::vector<Sighting> sightings;
        for (const Vector3d& dot : hall_dots()) {
          const auto pixel = truth.project(dot);
          if (!pixel || !in_picture(*pixel)) continue;
          sightings.push_back({dot, *pixel + kSigma_px * Vector2d{noise(), noise()}});
        }
        const auto fit = fitted(truth, sightings, {.survey_m = 0.0, .image_px = kSigma_px});
        ASSERT_TRUE(fit);
        for (const Sighting& sighting : sightings) {
          const Vector2d pixel = *fit->project(sighting.surveyed_m);
          left_over += (pixel - sighting.pixel).squaredNorm() / (kSigma_px * kSigma_px);
          const Vector2d true_pixel = *truth.project(sighting.surveyed_m);
          off += (pixel - true_pixel).squaredNorm() / (kSigma_px * kSigma_px);
        }
        const auto numbers = static_cast<double>(fitted_numbers(kind));
        expected_left_over += 2.0 * static_cast<double>(sightings.size()) - numbers;
        ++fits;
      }
    }
    EXPECT_NEAR(left_over / expected_left_over, 1.0, 0.03);
    // 96 fits: 4 standard deviations of the mean of chi squares.
    const auto numbers = static_cast<double>(fitted_numbers(kind));
    EXPECT_NEAR(off / fits, numbers, 4.0 * std::sqrt(2.0 * numbers / fits));
  }
}

// Measured over eight seeds: 0.061 to 0.073 px.
TEST(SurveyTest, AMillimetreOfSurveyIsAFractionOfAPixelInTheHall) {
  const auto truths = ceiling(LensKind::radial);
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double rms = rms_px(truths, calibrate(truths, {.seed = seed}));
    EXPECT_GT(rms, 0.045) << seed;
    EXPECT_LT(rms, 0.1) << seed;
    squares += rms * rms / 8.0;
  }
  RecordProperty("rms_px", std::to_string(std::sqrt(squares)));
  double fourfold = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double rms = rms_px(
        truths, calibrate(truths, {.survey_sigma_m = 0.004, .image_sigma_px = 0.2, .seed = seed}));
    fourfold += rms * rms / 8.0;
  }
  EXPECT_NEAR(std::sqrt(fourfold / squares), 4.0, 0.1);  // linear, the same noise four times over
}

TEST(SurveyTest, MoreDotsMakeABetterCalibration) {
  const auto truths = ceiling(LensKind::radial);
  double few = 0.0;
  double many = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    few += rms_px(truths, calibrate(truths, {.dots_per_camera = 25, .seed = seed}));
    many += rms_px(truths, calibrate(truths, {.dots_per_camera = 100, .seed = seed}));
  }
  EXPECT_GT(few, 1.5 * many);
}

bool same(const SimCamera& a, const SimCamera& b) {
  return a.centre_m() == b.centre_m() && a.rotation() == b.rotation() &&
         a.lens().focal_x_px == b.lens().focal_x_px && a.lens().radial == b.lens().radial;
}

TEST(SurveyTest, ASeedIsACalibration) {
  const auto truths = ceiling(LensKind::radial);
  const auto once = calibrate(truths, {.seed = 5});
  const auto again = calibrate(truths, {.seed = 5});
  const auto other = calibrate(truths, {.seed = 6});
  for (std::size_t i = 0; i < truths.size(); ++i) {
    EXPECT_TRUE(same(once[i], again[i]));
    EXPECT_FALSE(same(once[i], other[i]));
    EXPECT_FALSE(same(once[i], truths[i]));
  }
}

// A dot that was surveyed wrongly is as wrong for every camera that sees it; its centre in a
// picture is not.
TEST(SurveyTest, CamerasShareTheSurveysErrorsButNotTheImages) {
  const SimCamera camera = ceiling(LensKind::radial).front();
  const std::vector<SimCamera> twins(2, camera);
  const auto survey_only = calibrate(twins, {.dots_per_camera = 10000, .image_sigma_px = 0.0});
  EXPECT_LT(rms_px({survey_only[0]}, {survey_only[1]}), 1e-6);
  EXPECT_GT(rms_px({survey_only[0]}, {camera}), 0.01);
  const auto both = calibrate(twins, {.dots_per_camera = 10000});
  EXPECT_GT(rms_px({both[0]}, {both[1]}), 0.01);
}

TEST(SurveyTest, RefusesWhatDoesNotDetermineACamera) {
  const auto truths = ceiling(LensKind::radial);
  const auto nothing = calibrated(truths, {}, {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message, "camera 1 sees 0 calibration dots, at least 15 are needed");
  const std::vector<Vector3d> one_place(60, Vector3d(-5.0, 0.5, 0.0));
  const auto single = calibrated({&truths.front(), 1}, one_place, {.survey_sigma_m = 0.0});
  ASSERT_FALSE(single);
  EXPECT_NE(single.error().message.find("do not determine"), std::string::npos);
}

TEST(SurveyTest, CalibrationDotsLieOnTheFloorAndTheWalls) {
  int on_floor = 0;
  for (const Vector3d& dot : hall_dots()) {
    const bool floor = dot.z() == 0.0;
    on_floor += floor ? 1 : 0;
    EXPECT_TRUE(floor || std::abs(dot.x()) == 11.0 || std::abs(dot.y()) == 4.5);
    EXPECT_TRUE(std::abs(dot.x()) <= 11.0 && std::abs(dot.y()) <= 4.5 && dot.z() <= 3.0);
  }
  EXPECT_NEAR(on_floor, 600.0 * 198.0 / (198.0 + 186.0), 50.0);
}

}  // namespace
}  // namespace dottrack::host_sim
