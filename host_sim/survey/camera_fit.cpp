#include "host_sim/survey/camera_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dottrack::host_sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Numbers = std::array<double, kMostFitted>;
using Square = std::array<Numbers, kMostFitted>;

constexpr int kMostRounds = 100;
constexpr double kMostDamping = 1e6;
constexpr double kEnough = 1e-8;  // of a standard deviation, the length of the last step
// What is left of a unit of information on one number when all others are unknown.
constexpr double kSingular = 1e-8;
constexpr double kLeastSigma_px = 1e-3;  // where no errors were announced
// Of the differences that stand for derivatives: metres, radians, pixels, radial terms.
constexpr Numbers kSteps = {1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1e-5, 1e-2, 1e-2, 1e-2, 1e-2, 1e-4, 1e-4};

SimCamera moved(const SimCamera& camera, const Numbers& by) {
  Lens lens = camera.lens();
  lens.focal_x_px += by[6];
  lens.focal_y_px += by[7];
  lens.centre_x_px += by[8];
  lens.centre_y_px += by[9];
  lens.radial[1] += by[10];
  lens.radial[2] += by[11];
  return {camera.centre_m() + Vector3d(by[0], by[1], by[2]),
          turn({by[3], by[4], by[5]}) * camera.rotation(), lens, camera.width_px(),
          camera.height_px()};
}

// How far a surveyed dot may be from where the camera sees it.
std::optional<double> sigma_of(const SimCamera& camera, const Vector3d& p,
                               const SightingErrors& errors) {
  constexpr double kApart_m = 1e-3;
  double px_a_metre2 = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto ahead = camera.project(p + kApart_m * Vector3d::Unit(i));
    const auto behind = camera.project(p - kApart_m * Vector3d::Unit(i));
    if (!ahead || !behind) return std::nullopt;
    px_a_metre2 += (*ahead - *behind).squaredNorm() / (4.0 * kApart_m * kApart_m);
  }
  const double survey2_px = 0.5 * px_a_metre2 * errors.survey_m * errors.survey_m;
  return std::max(std::sqrt(survey2_px + errors.image_px * errors.image_px), kLeastSigma_px);
}

class Fit {
 public:
  Fit(std::span<const Sighting> sightings, std::span<const double> sigmas_px, std::size_t numbers)
      : sightings_(sightings), sigmas_px_(sigmas_px), numbers_(numbers) {}

  // In standard deviations, x and y of each sighting; false if the camera misses one.
  bool residuals(const SimCamera& camera, std::vector<double>& out) const {
    out.clear();
    for (std::size_t i = 0; i < sightings_.size(); ++i) {
      const auto pixel = camera.project(sightings_[i].surveyed_m);
      if (!pixel) return false;
      const Vector2d off = (*pixel - sightings_[i].pixel) / sigmas_px_[i];
      out.insert(out.end(), {off.x(), off.y()});
    }
    return true;
  }

  // The normal equations at a camera: normal * step = -gradient.
  bool linearise(const SimCamera& camera, const std::vector<double>& at, Square& normal,
                 Numbers& gradient) const {
    std::array<std::vector<double>, kMostFitted> columns;
    std::vector<double> low;
    for (std::size_t k = 0; k < numbers_; ++k) {
      Numbers step{};
      step[k] = kSteps[k];
      if (!residuals(moved(camera, step), columns[k])) return false;
      step[k] = -kSteps[k];
      if (!residuals(moved(camera, step), low)) return false;
      for (std::size_t i = 0; i < low.size(); ++i) {
        columns[k][i] = (columns[k][i] - low[i]) / (2.0 * kSteps[k]);
      }
    }
    for (std::size_t k = 0; k < numbers_; ++k) {
      gradient[k] = product(columns[k], at);
      for (std::size_t j = 0; j <= k; ++j) normal[k][j] = product(columns[k], columns[j]);
    }
    return true;
  }

  static double product(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

 private:
  std::span<const Sighting> sightings_;
  std::span<const double> sigmas_px_;
  std::size_t numbers_;
};

// Solves (normal + damping * its diagonal) x = -gradient, scaled to a unit diagonal, by Cholesky's
// method; nothing if that is singular.
std::optional<Numbers> solved(const Square& normal, const Numbers& gradient, double damping,
                              std::size_t n) {
  Numbers scale{};
  Square factor{};
  Numbers x{};
  for (std::size_t k = 0; k < n; ++k) {
    if (!(normal[k][k] > 0.0)) return std::nullopt;
    scale[k] = 1.0 / std::sqrt(normal[k][k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    double right = -gradient[k] * scale[k];
    for (std::size_t j = 0; j <= k; ++j) {
      double sum = j == k ? 1.0 + damping : normal[k][j] * scale[k] * scale[j];
      for (std::size_t i = 0; i < j; ++i) sum -= factor[k][i] * factor[j][i];
      if (j == k && !(sum > kSingular)) return std::nullopt;
      factor[k][j] = j == k ? std::sqrt(sum) : sum / factor[j][j];
      if (j < k) right -= factor[k][j] * x[j];
    }
    x[k] = right / factor[k][k];
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t i = k + 1; i < n; ++i) x[k] -= factor[i][k] * x[i];
    x[k] /= factor[k][k];
  }
  for (std::size_t k = 0; k < n; ++k) x[k] *= scale[k];
  return x;
}

// The step's length in standard deviations of what is fitted.
double length_of(const Numbers& step, const Square& normal, std::size_t n) {
  double most = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    most = std::max(most, std::abs(step[k]) * std::sqrt(normal[k][k]));
  }
  return most;
}

// A camera on its way to the best one.
struct Descent {
  SimCamera camera;
  std::vector<double> residuals;
  double damping;
};

enum class Progress { better, arrived, stuck };

Progress advance(const Fit& fit, std::size_t n, Descent& descent) {
  Square normal{};
  Numbers gradient{};
  if (!fit.linearise(descent.camera, descent.residuals, normal, gradient)) return Progress::stuck;
  const double cost = Fit::product(descent.residuals, descent.residuals);
  std::vector<double> tried;
  for (; descent.damping < kMostDamping; descent.damping *= 10.0) {
    const auto step = solved(normal, gradient, descent.damping, n);
    if (!step) return Progress::stuck;
    if (length_of(*step, normal, n) < kEnough) {
      const bool determined = solved(normal, gradient, 0.0, n).has_value();
      return determined ? Progress::arrived : Progress::stuck;  // stuck: held by the damping alone
    }
    const SimCamera next = moved(descent.camera, *step);
    if (fit.residuals(next, tried) && Fit::product(tried, tried) <= cost) {
      descent = {next, tried, 0.1 * descent.damping};
      return Progress::better;
    }
  }
  return Progress::stuck;
}

}  // namespace

std::size_t fitted_numbers(LensKind kind) {
  return kind == LensKind::pinhole ? kMostFitted - 2 : kMostFitted;
}

std::optional<SimCamera> fitted(const SimCamera& start, std::span<const Sighting> sightings,
                                const SightingErrors& errors) {
  const std::size_t n = fitted_numbers(start.lens().kind);
  if (2 * sightings.size() <= n) return std::nullopt;
  std::vector<double> sigmas_px;
  for (const Sighting& sighting : sightings) {
    const auto sigma_px = sigma_of(start, sighting.surveyed_m, errors);
    if (!sigma_px) return std::nullopt;
    sigmas_px.push_back(*sigma_px);
  }
  const Fit fit(sightings, sigmas_px, n);
  Descent descent{start, {}, 1e-3};
  if (!fit.residuals(start, descent.residuals)) return std::nullopt;
  for (int round = 0; round < kMostRounds; ++round) {
    const Progress progress = advance(fit, n, descent);
    if (progress == Progress::arrived) return descent.camera;
    if (progress == Progress::stuck) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace dottrack::host_sim
