#include "app/workstation/calibrate/fit/model_choice.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/workstation/calibrate/fit/chi_square.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;

constexpr double kCutSigmas2 = 16.0;     // a dot that is further off counts as this far
constexpr double kCoordinatesANumber = 1.5;  // fewest, of what a model is fitted to

// One camera alone, with the dots that it sees.
struct Alone {
  Adjustment adjustment;
  std::vector<std::size_t> dot;  // in the survey, of each of its dots
};

Alone alone(const AdjustedCamera& camera, std::span<const View> views,
            std::span<const AdjustedDot> dots) {
  Alone out;
  out.adjustment.cameras.push_back(camera);
  for (const View& view : views) {
    View own = view;
    own.camera = 0;
    own.dot = out.adjustment.dots.size();
    out.adjustment.views.push_back(own);
    out.adjustment.dots.push_back(dots[view.dot]);
    out.dot.push_back(view.dot);
  }
  return out;
}

bool fit(Adjustment& adjustment, Loss loss) { return solve(adjustment, loss, Precision::rough); }

// Squared sigmas of a view that the camera was not fitted to, its dot where it was surveyed.
double foretold(const Adjustment& a, const View& view, double& off2_px) {
  const AdjustedDot& dot = a.dots[view.dot];
  const auto linear = linear_view(a.cameras[0].camera, dot.surveyed_m);
  const auto model = model_of(a.cameras[0].camera);
  Vector2d pixel;
  if (!linear || project(model, dot.surveyed_m, pixel) != geometry::OpticsStatus::ok) {
    off2_px = std::numeric_limits<double>::infinity();
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::Vector3d variance = (a.survey_scale * dot.sigma_m).array().square().matrix();
  const double sigma_px = a.sigma_px(view);
  const Eigen::Matrix2d covariance =
      linear->by_point * variance.asDiagonal() * linear->by_point.transpose() +
      sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  const Vector2d off = pixel - view.pixel;
  off2_px = off.squaredNorm();
  return off.dot(covariance.inverse() * off);
}

struct Foretelling {
  std::vector<double> sigmas2;
  std::vector<double> off2_px;
  bool works = true;
};

Foretelling foretell(const Alone& whole, std::size_t folds) {
  Foretelling out;
  const std::size_t n = whole.adjustment.views.size();
  out.sigmas2.assign(n, 0.0);
  out.off2_px.assign(n, 0.0);
  for (std::size_t fold = 0; fold < folds && out.works; ++fold) {
    Adjustment part = whole.adjustment;
    bool any = false;
    for (View& view : part.views) {
      view.kept = fold_of(whole.dot[view.dot], folds) != fold;
      any = any || !view.kept;
    }
    if (!any) continue;
    out.works = fit(part, Loss::huber);
    for (std::size_t i = 0; i < n; ++i) {
      if (!part.views[i].kept) out.sigmas2[i] = foretold(part, part.views[i], out.off2_px[i]);
    }
  }
  return out;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Trial {
  LensKind kind;
  NumberedCamera camera;
  Foretelling foretelling;
};

// How much worse, on average over the dots, and how sure that is.
struct Comparison {
  double mean = 0.0;
  double error = 0.0;
};

Comparison compare(const Foretelling& a, const Foretelling& b, double unit) {
  const auto n = static_cast<double>(a.sigmas2.size());
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < a.sigmas2.size(); ++i) {
    const double difference = std::min(a.sigmas2[i] / unit, kCutSigmas2) -
                              std::min(b.sigmas2[i] / unit, kCutSigmas2);
    sum += difference;
    square += difference * difference;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(square / n - mean * mean, 0.0) / n)};
}

double cut_mean(const Foretelling& f, double unit) {
  double sum = 0.0;
  for (const double s : f.sigmas2) sum += std::min(s / unit, kCutSigmas2);
  return sum / static_cast<double>(f.sigmas2.size());
}

TriedKind summary(const Trial& trial, double unit) {
  TriedKind tried{trial.kind, std::numeric_limits<double>::infinity(),
                  cut_mean(trial.foretelling, unit), false};
  if (!trial.foretelling.works) return tried;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < trial.foretelling.sigmas2.size(); ++i) {
    if (trial.foretelling.sigmas2[i] > kCutSigmas2 * unit) continue;
    sum += trial.foretelling.off2_px[i];
    count += 1.0;
  }
  if (count > 0.0) tried.holdout_rms_px = std::sqrt(sum / count);
  return tried;
}

bool enough(const LensKind& kind, std::size_t views) {
  return 2.0 * static_cast<double>(views) >= kCoordinatesANumber * count_free(kind);
}

// A camera noisier or a survey worse than claimed would drown the robust losses.
void scale_to(Adjustment& adjustment, double factor) {
  adjustment.cameras[0].image_scale *= factor;
  adjustment.survey_scale *= factor;
}

double median_sigmas2(const Adjustment& a) {
  std::vector<double> all;
  double ignored = 0.0;
  for (const View& view : a.views) all.push_back(foretold(a, view, ignored));
  return median(all);
}

// Fitted from wide to narrow, until the residuals are what the sigmas say.
bool fit_to_scale(Adjustment& adjustment) {
  constexpr int kRounds = 3;
  for (int i = 0; i < kRounds; ++i) {
    const double middle = median_sigmas2(adjustment);
    if (!std::isfinite(middle)) return false;
    scale_to(adjustment, std::sqrt(std::max(middle, 1e-6) / kMedian2));
    for (AdjustedDot& dot : adjustment.dots) dot.offset_m.setZero();
    if (!fit(adjustment, i == 0 ? Loss::cauchy : Loss::huber)) return false;
  }
  return true;
}

}  // namespace

std::vector<LensKind> candidates(ModelKind kind) {
  const LensKind pinhole{LensForm::pinhole, false, false, 1.0};
  const LensKind one{LensForm::radial, false, false, 1.0};
  const LensKind two{LensForm::radial, false, true, 1.0};
  const LensKind full{LensForm::radial, true, true, 1.0};
  const LensKind perspective{LensForm::pupil, true, true, 1.0};
  const LensKind fish_eye{LensForm::pupil, true, true, 0.0};
  switch (kind) {
    case ModelKind::automatic:
      return {pinhole, one, two, full, perspective, fish_eye};
    case ModelKind::cahv:
      return {pinhole};
    case ModelKind::cahv_radial:
      return {one};
    case ModelKind::cahvor:
      return {full};
    case ModelKind::cahvore:
      return {perspective, fish_eye};
  }
  return {};
}

ModelKind kind_of(const LensKind& kind) {
  if (kind.form == LensForm::pinhole) return ModelKind::cahv;
  if (kind.form == LensForm::pupil) return ModelKind::cahvore;
  return kind.two_radial || kind.own_axis ? ModelKind::cahvor : ModelKind::cahv_radial;
}

std::string words_of(const LensKind& kind) {
  if (kind.form == LensForm::pinhole) return "CAHV";
  if (kind.form == LensForm::pupil) {
    return kind.linearity == 0.0 ? "CAHVORE, fish-eye" : "CAHVORE, perspective";
  }
  if (kind.own_axis) return "CAHVOR";
  return kind.two_radial ? "CAHVOR, O = A" : "CAHVOR, O = A, r1 alone";
}

std::optional<Choice> choose(const StartedCamera& camera, std::span<const View> views,
                             std::span<const LensKind> kinds, const ChoiceSetup& setup) {
  std::vector<Trial> trials;
  double unit = std::numeric_limits<double>::infinity();
  for (const LensKind& kind : kinds) {
    if (kinds.size() > 1 && !enough(kind, views.size()) && !trials.empty()) continue;
    Alone whole = alone(prepared(camera, kind, setup.seed), views, setup.dots);
    if (!fit_to_scale(whole.adjustment)) continue;
    trials.push_back({kind, whole.adjustment.cameras[0].camera, {}});
    if (kinds.size() == 1) break;
    trials.back().foretelling = foretell(whole, setup.folds);
    // Each was weighed by its own scale; compare in one.
    const double scale = whole.adjustment.survey_scale;
    for (double& s : trials.back().foretelling.sigmas2) s *= scale * scale;
    if (trials.back().foretelling.works) {
      unit = std::min(unit, median(trials.back().foretelling.sigmas2) / kMedian2);
    }
  }
  if (trials.empty()) return std::nullopt;
  if (trials.size() == 1) return Choice{trials[0].kind, trials[0].camera, {}};
  const auto worse = [&](const Trial& a, const Trial& b) {
    return cut_mean(a.foretelling, unit) < cut_mean(b.foretelling, unit);
  };
  std::erase_if(trials, [](const Trial& t) { return !t.foretelling.works; });
  if (trials.empty()) return std::nullopt;
  const Trial& best = *std::min_element(trials.begin(), trials.end(), worse);
  Choice choice{best.kind, best.camera, {}};
  bool chosen = false;
  for (const Trial& trial : trials) {
    choice.tried.push_back(summary(trial, unit));
    const Comparison c = compare(trial.foretelling, best.foretelling, unit);
    if (chosen || c.mean > c.error) continue;
    choice.kind = trial.kind;
    choice.camera = trial.camera;
    choice.tried.back().chosen = true;
    chosen = true;
  }
  return choice;
}

}  // namespace dottrack::calibrate
