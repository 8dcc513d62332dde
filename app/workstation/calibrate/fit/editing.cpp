#include "app/workstation/calibrate/fit/editing.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/workstation/calibrate/fit/chi_square.h"
#include "app/workstation/calibrate/fit/habits.h"

namespace dottrack::calibrate {
namespace {

constexpr double kFalseViews = 0.005;  // expected number of good views left out
constexpr double kFalseDots = 0.0005;  // ... and of good dots suspected
constexpr double kHysteresis = 0.8;    // of the surprise, below which something comes back
constexpr int kMostReturns = 2;        // of the same view
constexpr double kLeastPart = 0.01;  // of a direction's variance, in which a residual tells a thing
constexpr std::size_t kFewestViews = 6;  // that editing leaves a camera

// r^T C^-1 r over the directions in which the residual is not explained away.
template <int N>
double squared_sigmas(const Judged<N>& judged) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(judged.covariance);
  double sum = 0.0;
  for (int i = 0; i < N; ++i) {
    const double variance = solver.eigenvalues()[i];
    if (variance < kLeastPart) continue;
    const double along = solver.eigenvectors().col(i).dot(judged.residual);
    sum += along * along / variance;
  }
  return sum;
}

std::vector<std::size_t> kept_views_of_dots(const Adjustment& adjustment) {
  std::vector<std::size_t> count(adjustment.dots.size(), 0);
  for (const View& view : adjustment.views) count[view.dot] += view.kept ? 1 : 0;
  return count;
}

std::vector<std::size_t> kept_views_of_cameras(const Adjustment& adjustment) {
  std::vector<std::size_t> count(adjustment.cameras.size(), 0);
  for (const View& view : adjustment.views) count[view.camera] += view.kept ? 1 : 0;
  return count;
}

double limit(double false_alarms, std::size_t tests) {
  return -std::log(false_alarms / static_cast<double>(std::max<std::size_t>(tests, 1)));
}

}  // namespace

Surprises surprises(const Adjustment& adjustment, const Information& information) {
  Surprises all;
  for (const Judged<2>& view : information.views) {
    all.views.push_back(view.known ? surprise2(squared_sigmas(view)) : 0.0);
  }
  const auto kept = kept_views_of_dots(adjustment);
  for (std::size_t i = 0; i < information.surveys.size(); ++i) {
    const bool told = information.surveys[i].known && kept[i] >= kLeastViewsOfDot;
    all.surveys.push_back(told ? surprise3(squared_sigmas(information.surveys[i])) : 0.0);
  }
  return all;
}

Editor::Editor(const Adjustment& adjustment)
    : returns_of_views_(adjustment.views.size(), 0),
      returns_of_surveys_(adjustment.dots.size(), 0) {}

bool Editor::bring_back(Adjustment& adjustment, const Surprises& all) {
  bool changed = false;
  const double most_view = kHysteresis * limit(kFalseViews, all.views.size());
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    View& view = adjustment.views[i];
    if (view.kept || all.views[i] > most_view || returns_of_views_[i] >= kMostReturns) continue;
    view.kept = true;
    ++returns_of_views_[i];
    changed = true;
  }
  const double most_dot = kHysteresis * limit(kFalseDots, all.surveys.size());
  for (std::size_t i = 0; i < all.surveys.size(); ++i) {
    AdjustedDot& dot = adjustment.dots[i];
    if (dot.trusted || all.surveys[i] > most_dot || returns_of_surveys_[i] >= kMostReturns)
      continue;
    dot.trusted = true;
    ++returns_of_surveys_[i];
    changed = true;
  }
  return changed;
}

bool Editor::leave_out(Adjustment& adjustment, const Surprises& all) {
  // The worst first; of equals the one that comes first.
  std::vector<std::tuple<double, bool, std::size_t>> worst;
  const double view_limit = limit(kFalseViews, all.views.size());
  for (std::size_t i = 0; i < all.views.size(); ++i) {
    if (adjustment.views[i].kept && all.views[i] > view_limit) {
      worst.emplace_back(-all.views[i], false, i);
    }
  }
  const double dot_limit = limit(kFalseDots, all.surveys.size());
  for (std::size_t i = 0; i < all.surveys.size(); ++i) {
    if (adjustment.dots[i].trusted && all.surveys[i] > dot_limit) {
      worst.emplace_back(-all.surveys[i], true, i);
    }
  }
  std::sort(worst.begin(), worst.end());
  auto of_dot = kept_views_of_dots(adjustment);
  auto of_camera = kept_views_of_cameras(adjustment);
  std::vector<bool> camera_touched(adjustment.cameras.size(), false);
  std::vector<bool> dot_touched(adjustment.dots.size(), false);
  bool changed = false;
  for (const auto& [minus, is_dot, i] : worst) {
    if (is_dot) {
      bool free = !dot_touched[i];
      for (const View& v : adjustment.views) {
        free = free && !(v.dot == i && v.kept && camera_touched[v.camera]);
      }
      if (!free) continue;
      adjustment.dots[i].trusted = false;
      dot_touched[i] = true;
      for (const View& v : adjustment.views) {
        if (v.dot == i && v.kept) camera_touched[v.camera] = true;
      }
      changed = true;
      continue;
    }
    View& view = adjustment.views[i];
    const bool needed =
        of_camera[view.camera] <= kFewestViews ||
        (!adjustment.dots[view.dot].trusted && of_dot[view.dot] <= kLeastViewsOfDot);
    if (camera_touched[view.camera] || dot_touched[view.dot] || needed) continue;
    view.kept = false;
    camera_touched[view.camera] = true;
    dot_touched[view.dot] = true;
    changed = true;
  }
  return changed;
}

bool Editor::edit(Adjustment& adjustment, const Information& information) {
  const Surprises all = surprises(adjustment, information);
  const bool back = bring_back(adjustment, all);
  return leave_out(adjustment, all) || back;
}

namespace {

constexpr double kLeastImageSigma_px = 0.003;
constexpr double kLeastSurveySigma = 1e-7;  // of the distance
constexpr double kEnoughRedundancy = 20.0;
constexpr double kLeastBelief = 20.0;  // coordinates
constexpr double kMostBelief = 200.0;

struct Sums {
  double square = 0.0;
  double redundancy = 0.0;
  std::vector<double> relative;  // squared sigmas, where it is done by medians

  double factor2(bool robust, double median) const {
    if (!robust) return redundancy > 0.0 ? square / redundancy : 1.0;
    if (relative.empty()) return 1.0;
    std::vector<double> sorted = relative;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2] / median;
  }
};

template <int N>
void add(const Judged<N>& judged, Sums& sums) {
  const double length = judged.residual.norm();
  // As the fit itself weighs it.
  const double weight = length > kHuberSigmas ? kHuberSigmas / length : 1.0;
  sums.square += weight * length * length;
  sums.redundancy += judged.redundancy();
  sums.relative.push_back(squared_sigmas(judged));
}

// Coordinates that several cameras have in common beyond what a dot's place takes.
double common_redundancy(const Adjustment& adjustment) {
  double sum = 0.0;
  for (const std::size_t views : kept_views_of_dots(adjustment)) {
    if (views >= 2) sum += 2.0 * static_cast<double>(views) - 3.0;
  }
  double numbers = 0.0;
  for (const AdjustedCamera& c : adjustment.cameras) numbers += count_free(c.camera.kind);
  return sum - numbers;
}

// As many coordinates as a camera's noise is believed to be that of all, from by how much more than
// chance makes them the cameras' variances differ: one from n coordinates is off by sqrt(2 / n).
double belief_in_common(const std::vector<Sums>& cameras, const std::vector<double>& relative) {
  double excess = 0.0;
  double redundancy = 0.0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    excess += cameras[i].redundancy * std::pow(relative[i] - 1.0, 2) - 2.0;
    redundancy += cameras[i].redundancy;
  }
  if (!(excess > 0.0)) return kMostBelief;
  return std::clamp(2.0 * redundancy / excess, kLeastBelief, kMostBelief);
}

double scale_by(double& scale, double factor2, double least) {
  const double before = scale;
  scale = std::max(scale * std::sqrt(std::max(factor2, 1e-6)), least);
  return std::abs(std::log(scale / before));
}

double scale_all(Adjustment& adjustment, double factor2, double least) {
  double change = 0.0;
  for (AdjustedCamera& c : adjustment.cameras) {
    change = std::max(change, scale_by(c.image_scale, factor2, least));
  }
  return change;
}

// Each camera's as it shows, drawn to that of all as far as they are alike.
double scale_each(Adjustment& adjustment, const std::vector<Sums>& cameras, double least) {
  std::vector<double> variance;
  double sum = 0.0;
  double redundancy = 0.0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const double scale2 = std::pow(adjustment.cameras[i].image_scale, 2);
    variance.push_back(cameras[i].factor2(false, kMedian2) * scale2);
    sum += cameras[i].redundancy * variance.back();
    redundancy += cameras[i].redundancy;
  }
  if (!(redundancy > 0.0)) return 0.0;
  const double common = sum / redundancy;
  std::vector<double> relative;
  for (const double v : variance) relative.push_back(v / common);
  const double belief = belief_in_common(cameras, relative);
  double change = 0.0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const double weight = std::max(cameras[i].redundancy, 0.0);
    const double wanted = (weight * variance[i] + belief * common) / (weight + belief);
    double& scale = adjustment.cameras[i].image_scale;
    change = std::max(change, scale_by(scale, wanted / (scale * scale), least));
  }
  return change;
}

double least_sigma_px(const Adjustment& adjustment) {
  double least = 1e9;
  for (const View& view : adjustment.views) least = std::min(least, view.sigma_px);
  return least;
}

double least_survey_scale(const Adjustment& adjustment) {
  double sigma = 1e9;
  double distance = 1.0;
  for (const AdjustedDot& dot : adjustment.dots) sigma = std::min(sigma, dot.sigma_m.minCoeff());
  for (const AdjustedCamera& c : adjustment.cameras) distance = c.camera.frame.distance_m;
  return kLeastSurveySigma * distance / sigma;
}

}  // namespace

double estimate_noise(Adjustment& adjustment, const Information& information,
                      const NoiseOptions& options) {
  if (!options.estimate) return 0.0;
  std::vector<Sums> cameras(adjustment.cameras.size());
  Sums image;
  Sums survey;
  for (std::size_t i = 0; i < adjustment.views.size(); ++i) {
    if (!adjustment.views[i].kept || !information.views[i].known) continue;
    add(information.views[i], cameras[adjustment.views[i].camera]);
    add(information.views[i], image);
  }
  for (std::size_t i = 0; i < adjustment.dots.size(); ++i) {
    if (adjustment.dots[i].trusted && information.surveys[i].known) {
      add(information.surveys[i], survey);
    }
  }
  const double least_image = kLeastImageSigma_px / least_sigma_px(adjustment);
  const double least_survey = least_survey_scale(adjustment);
  double change = 0.0;
  if (common_redundancy(adjustment) < kEnoughRedundancy) {
    // One cannot be told from the other: both are larger or smaller.
    Sums both = image;
    both.square += survey.square;
    both.redundancy += survey.redundancy;
    const double factor2 = both.factor2(options.robust, kMedian2);
    change = scale_all(adjustment, factor2, least_image);
    return std::max(change, scale_by(adjustment.survey_scale, factor2, least_survey));
  }
  change = options.for_each_camera
               ? scale_each(adjustment, cameras, least_image)
               : scale_all(adjustment, image.factor2(options.robust, kMedian2), least_image);
  return std::max(change, scale_by(adjustment.survey_scale,
                                   survey.factor2(options.robust, kMedian3), least_survey));
}

std::optional<Information> adjust_and_edit(Adjustment& adjustment, bool estimate) {
  constexpr int kMostRounds = 60;
  constexpr double kSameNoise = 0.01;
  Editor editor(adjustment);
  std::optional<Information> information;
  bool robust = true;
  for (int round = 0; round < kMostRounds; ++round) {
    if (!solve(adjustment, Loss::huber)) return std::nullopt;
    information = inform(adjustment);
    if (!information) return std::nullopt;
    double change = estimate_noise(adjustment, *information, {estimate, robust, !robust});
    if (!robust) change = std::max(change, learn_habits(adjustment, *information));
    // Settle the noise first: all tests are by it.
    const bool settled = change < (robust ? 0.05 : kSameNoise);
    const bool edited = change < 0.5 && editor.edit(adjustment, *information);
    if (settled && !edited) {
      if (!robust) return information;
      robust = false;
    }
  }
  if (!solve(adjustment, Loss::huber)) return std::nullopt;
  return inform(adjustment);
}

}  // namespace dottrack::calibrate
