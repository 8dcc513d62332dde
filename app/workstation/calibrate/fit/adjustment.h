#pragma once
// Least squares over cameras and dots together: a bundle adjustment in which the survey is as good
// a witness of where the dots are as it claims to be.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/workstation/calibrate/fit/camera_numbers.h"

namespace dottrack::calibrate {

// Of a number's distance from zero; that of a radial term from the common lens's, where there is
// one.
struct NumberPriors {
  Numbers sigma{};    // 0: nothing is known of the number
  Numbers loosest{};  // the most that sigma may become where it is learnt from the cameras
};

struct AdjustedCamera {
  NumberedCamera camera;
  NumberPriors priors;
  double image_scale = 1.0;  // factor of its views' sigmas
};

struct AdjustedDot {
  Eigen::Vector3d surveyed_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Constant(0.001);  // above 0
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();          // from the survey
  bool trusted = true;  // else its place comes from the views alone

  Eigen::Vector3d position_m() const { return surveyed_m + offset_m; }
};

struct View {
  std::size_t camera = 0;
  std::size_t dot = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma_px = 0.1;
  bool kept = true;
};

// What lenses of one make bend: itself unknown, and adjusted with all the rest.
struct CommonLens {
  bool exists = false;  // else each camera's radial terms are on their own
  std::array<double, kRadialTerms> radial{};
};

struct Adjustment {
  std::vector<AdjustedCamera> cameras;
  CommonLens lens;
  std::vector<AdjustedDot> dots;
  std::vector<View> views;
  double survey_scale = 1.0;  // factor of the dots' sigmas

  double sigma_px(const View& view) const {
    return view.sigma_px * cameras[view.camera].image_scale;
  }
  // Whether a number of a camera is known by what the lenses have in common.
  bool shares(const AdjustedCamera& camera, int number) const {
    return lens.exists && number >= kRadial && number < kRadial + kRadialTerms &&
           is_free(camera.camera.kind, number) &&
           camera.priors.sigma[static_cast<std::size_t>(number)] > 0.0;
  }
};

// As little is known of the common lens beforehand as of any of the lenses.
std::array<double, kRadialTerms> lens_sigma(const Adjustment& adjustment);

enum class Loss : std::uint8_t {
  squares,
  huber,   // beyond kHuberSigmas a residual counts by its length
  cauchy,  // far residuals count for nearly nothing: for starts
};
inline constexpr double kHuberSigmas = 3.0;
inline constexpr double kCauchySigmas = 2.0;

enum class Precision : std::uint8_t {
  rough,  // a thousandth of a standard deviation, for comparisons
  full,   // so that every start ends in the same place
};

// From where the adjustment stands to the nearest optimum, in one thread: the same bits every time.
// Afterwards its cameras are rebased. False where the start sees a kept view's dot behind a camera,
// or the numbers run away.
bool solve(Adjustment& adjustment, Loss loss, Precision precision = Precision::full);

// Dots that no kept view shows are where they were surveyed; a dot that is not trusted needs two.
inline constexpr std::size_t kLeastViewsOfDot = 2;

}  // namespace dottrack::calibrate
