#include "app/workstation/calibrate/fit/model_choice.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "app/workstation/calibrate/fit/chi_square.h"
#include "app/workstation/calibrate/fit/editing.h"
#include "app/workstation/calibrate/fit/foretelling.h"
#include "app/workstation/calibrate/fit/lone_fit.h"
#include "app/workstation/calibrate/fit/parallel.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kCoordinatesANumber = 1.5;  // fewest, of what a model is fitted to
constexpr double kWithinNoise = 1.0;         // standard errors that a simpler model may be worse by
constexpr double kPupilGain = 0.93;     // of the residuals of a camera alone, to try a moving pupil
constexpr double kPupilErrors = 3.0;    // standard errors by which it must be better
constexpr double kAlike = 1.5;          // of focal lengths
constexpr double kContradiction = 1.5;  // standard errors by which a camera itself disagrees
constexpr std::size_t kFolds = 5;

bool enough(const LensKind& kind, std::size_t views) {
  return 2.0 * static_cast<double>(views) >= kCoordinatesANumber * count_free(kind);
}

class Chooser {
 public:
  explicit Chooser(const ChoiceSetup& setup)
      : setup_(setup), kinds_(candidates(setup.options.kind)) {}

  Result<std::vector<Choice>> choose() {
    fit_alone_all();
    if (stopped_) return fail("calibration interrupted");
    for (std::size_t i = 0; i < setup_.cameras.size(); ++i) {
      if (simplest(i)) continue;
      return fail(
          fmt::format("camera {}: no model fits its {} dots: their labels are wrong, or it "
                      "saw too few",
                      setup_.views[i].name, setup_.views[i].observations.size()));
    }
    if (setup_.options.kind != ModelKind::automatic) return without_choice();
    refer();
    if (!go_on(0.6)) return fail("calibration interrupted");
    foretell_all();
    return best_of_each();
  }

 private:
  using OfKind = std::vector<std::optional<LoneFit>>;

  bool go_on(double part) {
    if (setup_.go_on && !setup_.go_on(part)) stopped_ = true;
    return !stopped_;
  }

  AdjustedCamera prepare(std::size_t camera, const LensKind& kind) const {
    const std::uint64_t seed = setup_.options.seed;
    return prepared(setup_.cameras[camera], kind, seed == 0 ? 0 : seed + 7919 * camera);
  }

  void fit_alone_all() {
    alone_.assign(setup_.cameras.size(), OfKind(kinds_.size()));
    std::atomic<std::size_t> done{0};
    for_each_index(alone_.size(), setup_.options.threads, [&](std::size_t i) {
      const std::vector<View> views = views_of(setup_.views[i], i);
      for (std::size_t k = 0; k < kinds_.size() && !stopped_; ++k) {
        if (k > 0 && !enough(kinds_[k], views.size())) continue;
        alone_[i][k] = fit_alone(prepare(i, kinds_[k]), views, setup_.dots);
      }
      go_on(0.5 * static_cast<double>(++done) / static_cast<double>(alone_.size()));
    });
  }

  std::optional<std::size_t> simplest(std::size_t camera) const {
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      if (alone_[camera][k]) return k;
    }
    return std::nullopt;
  }

  bool pupil_pays(std::size_t camera, std::size_t kind) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      if (kinds_[k].form == LensForm::pupil || !alone_[camera][k]) continue;
      least = std::min(least, alone_[camera][k]->scale);
    }
    return alone_[camera][kind]->scale < kPupilGain * least;
  }

  // The richest that is worth it, up to a level.
  std::size_t richest(std::size_t camera, std::size_t level) const {
    std::size_t best = *simplest(camera);
    for (std::size_t k = 0; k <= level; ++k) {
      if (!alone_[camera][k]) continue;
      if (kinds_[k].form == LensForm::pupil && !pupil_pays(camera, k)) continue;
      if (kinds_[best].form == LensForm::pupil &&
          alone_[camera][k]->scale > alone_[camera][best]->scale) {
        continue;
      }
      best = k;
    }
    return best;
  }

  AdjustedCamera camera_of(std::size_t camera, std::size_t kind) const {
    AdjustedCamera out = prepare(camera, kinds_[kind]);
    out.camera = alone_[camera][kind]->camera;
    return out;
  }

  std::vector<Choice> without_choice() const {
    std::vector<Choice> out;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      std::size_t best = *simplest(i);
      for (std::size_t k = 0; k < kinds_.size(); ++k) {
        if (alone_[i][k] && alone_[i][k]->scale < alone_[i][best]->scale) best = k;
      }
      out.push_back({camera_of(i, best), {}});
    }
    return out;
  }

  // All cameras with their richest kind say what is to be left out, how noisy all is and where the
  // dots are.
  void refer() {
    reference_.dots.assign(setup_.dots.begin(), setup_.dots.end());
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      reference_.cameras.push_back(camera_of(i, richest(i, kinds_.size() - 1)));
      const std::vector<View> own = views_of(setup_.views[i], i);
      reference_.views.insert(reference_.views.end(), own.begin(), own.end());
    }
    const auto information = adjust_and_edit(reference_, setup_.options.estimate_noise);
    for (const View& view : reference_.views) {
      Matrix2d covariance = std::pow(reference_.sigma_px(view), 2) * Matrix2d::Identity();
      const auto linear = linear_view(reference_.cameras[view.camera].camera,
                                      reference_.dots[view.dot].position_m());
      if (linear && information) {
        covariance += linear->by_point * information->dots[view.dot] * linear->by_point.transpose();
      }
      weights_.push_back(covariance.inverse());
    }
  }

  Adjustment of_level(std::size_t level) const {
    Adjustment out = reference_;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      const std::size_t kind = richest(i, level);
      AdjustedCamera& c = out.cameras[i];
      if (kinds_[kind].form == LensForm::pupil || c.camera.kind.form != LensForm::pupil) {
        c.camera = alone_[i][kind]->camera;  // with what was learnt of its priors
      } else {
        c = camera_of(i, kind);
        c.image_scale = reference_.cameras[i].image_scale;
      }
    }
    return out;
  }

  void foretell_all() {
    foretold_.assign(kinds_.size(), std::vector<Foretelling>(alone_.size()));
    std::vector<std::vector<double>> sigmas2(kinds_.size());
    std::vector<std::vector<double>> off2_px(kinds_.size());
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      sigmas2[k].assign(reference_.views.size(), std::numeric_limits<double>::infinity());
      off2_px[k] = sigmas2[k];
    }
    for_each_index(kinds_.size() * kFolds, setup_.options.threads, [&](std::size_t job) {
      const std::size_t level = job / kFolds;
      foretell(level, job % kFolds, sigmas2[level], off2_px[level]);
    });
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      for (std::size_t i = 0; i < reference_.views.size(); ++i) {
        if (!reference_.views[i].kept) continue;
        Foretelling& f = foretold_[k][reference_.views[i].camera];
        f.sigmas2.push_back(sigmas2[k][i]);
        f.off2_px.push_back(off2_px[k][i]);
      }
    }
  }

  bool new_on_level(std::size_t level) const {
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      if (richest(i, level) == level) return true;
    }
    return false;
  }

  void foretell(std::size_t level, std::size_t fold, std::vector<double>& sigmas2,
                std::vector<double>& off2_px) const {
    if (!new_on_level(level)) return;
    Adjustment part = of_level(level);
    for (View& view : part.views) {
      // Dots without a trusted place need their other views.
      const bool left_out = fold_of(view.dot + view.camera, kFolds) == fold;
      view.kept = view.kept && !(left_out && part.dots[view.dot].trusted);
    }
    if (!solve(part, Loss::huber, Precision::rough)) return;
    for (std::size_t i = 0; i < part.views.size(); ++i) {
      const View& view = part.views[i];
      if (fold_of(view.dot + view.camera, kFolds) != fold) continue;
      Vector2d pixel;
      if (project(model_of(part.cameras[view.camera].camera), part.dots[view.dot].position_m(),
                  pixel) != geometry::OpticsStatus::ok) {
        continue;
      }
      const Vector2d off = pixel - view.pixel;
      sigmas2[i] = off.dot(weights_[i] * off);
      off2_px[i] = off.squaredNorm();
    }
  }

  // Levels that mean something for a camera, and the scale of its squared sigmas.
  struct Standing {
    std::vector<std::size_t> levels;
    double unit = std::numeric_limits<double>::infinity();
  };

  Standing standing(std::size_t camera) const {
    Standing out;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const Foretelling& f = foretold_[k][camera];
      if (richest(camera, k) != k || f.sigmas2.empty()) continue;
      const double middle = median(f.sigmas2);
      if (!std::isfinite(middle)) continue;
      out.unit = std::min(out.unit, middle / kMedian2);
      out.levels.push_back(k);
    }
    return out;
  }

  // Lenses of one make are judged together: their fields of view are nearly the same.
  bool alike(std::size_t a, std::size_t b) const {
    const auto part = [&](std::size_t i) {
      const ImageExtent extent = setup_.cameras[i].extent;
      const NumberedCamera& camera = alone_[i][*simplest(i)]->camera;
      return camera.frame.focal_px * std::exp(camera.numbers[kScale]) /
             std::max(extent.width_px, extent.height_px);
    };
    return std::abs(std::log(part(a) / part(b))) < std::log(kAlike);
  }

  Foretelling of_alike(std::size_t level, std::size_t camera,
                       std::span<const Standing> standings) const {
    Foretelling all;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      if (!alike(camera, i) || standings[i].levels.empty()) continue;
      for (const double s : foretold_[level][i].sigmas2) {
        all.sigmas2.push_back(s / standings[i].unit);
      }
    }
    return all;
  }

  // The simplest that is as good as the best, within the noise.
  std::size_t simplest_good(std::span<const std::size_t> levels,
                            const std::function<Foretelling(std::size_t)>& of) const {
    std::vector<Foretelling> all;
    for (const std::size_t k : levels) all.push_back(of(k));
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Comparison gain = compare(all[best], all[i]);
      // A moving pupil explains many a thing that is none.
      const bool pupil =
          kinds_[levels[i]].form == LensForm::pupil && kinds_[levels[best]].form != LensForm::pupil;
      if (gain.mean > (pupil ? kPupilErrors * gain.error : 0.0)) best = i;
    }
    for (std::size_t i = 0; i < best; ++i) {
      const Comparison loss = compare(all[i], all[best]);
      if (loss.mean <= kWithinNoise * loss.error) return levels[i];
    }
    return levels[best];
  }

  Choice best_of(std::size_t camera, std::span<const Standing> standings) const {
    const Standing& own = standings[camera];
    if (own.levels.empty()) return {camera_of(camera, *simplest(camera)), {}};
    const auto of_own = [&](std::size_t k) {
      Foretelling f = foretold_[k][camera];
      for (double& s : f.sigmas2) s /= own.unit;
      return f;
    };
    std::size_t taken =
        simplest_good(own.levels, [&](std::size_t k) { return of_alike(k, camera, standings); });
    const std::size_t alone = simplest_good(own.levels, of_own);
    const Comparison loss = compare(of_own(taken), of_own(alone));
    if (loss.mean > kContradiction * loss.error) taken = alone;
    Choice choice{camera_of(camera, taken), {}};
    for (const std::size_t k : own.levels) {
      choice.tried.push_back({kinds_[k], rms_px(foretold_[k][camera], own.unit), k == taken});
    }
    return choice;
  }

  std::vector<Choice> best_of_each() const {
    std::vector<Choice> out;
    std::vector<Standing> standings;
    for (std::size_t i = 0; i < alone_.size(); ++i) standings.push_back(standing(i));
    for (std::size_t i = 0; i < alone_.size(); ++i) out.push_back(best_of(i, standings));
    return out;
  }

  const ChoiceSetup& setup_;
  std::vector<LensKind> kinds_;
  std::atomic<bool> stopped_{false};
  std::vector<OfKind> alone_;  // of each camera and kind
  Adjustment reference_;
  std::vector<Matrix2d> weights_;                   // of each view
  std::vector<std::vector<Foretelling>> foretold_;  // of each kind and camera
};

}  // namespace

std::vector<LensKind> candidates(ModelKind kind) {
  const LensKind pinhole{LensForm::pinhole, false, false, 1.0};
  const LensKind one{LensForm::radial, false, false, 1.0};
  const LensKind full{LensForm::radial, true, true, 1.0};
  const LensKind perspective{LensForm::pupil, true, true, 1.0};
  const LensKind fish_eye{LensForm::pupil, true, true, 0.0};
  switch (kind) {
    case ModelKind::automatic:
      return {pinhole, one, full, perspective, fish_eye};
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

Result<std::vector<Choice>> choose(const ChoiceSetup& setup) {
  return Chooser(setup).choose();
}

}  // namespace dottrack::calibrate
