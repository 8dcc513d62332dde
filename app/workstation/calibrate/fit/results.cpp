#include "app/workstation/calibrate/fit/results.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/workstation/calibrate/fit/chi_square.h"
#include "app/workstation/calibrate/fit/editing.h"

namespace dottrack::calibrate {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPoorCoverage = 0.4;
constexpr double kHeldByPrior = 0.7;  // of its prior sigma: the data add little

class Rms {
 public:
  void add(double square) {
    sum_ += square;
    ++count_;
  }
  double value() const { return count_ == 0 ? 0.0 : std::sqrt(sum_ / static_cast<double>(count_)); }
  std::size_t count() const { return count_; }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

std::vector<Vector2d> hull_of(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double area_of(const std::vector<Vector2d>& hull) {
  double twice = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    twice += cross(hull[i], hull[(i + 1) % hull.size()]);
  }
  return 0.5 * std::abs(twice);
}

using Square = Eigen::Matrix<double, kNumbers, kNumbers>;

double root_of(const Square& covariance, int from, int count) {
  return std::sqrt(covariance.diagonal().segment(from, count).sum());
}

ParameterSigmas sigmas_of(const NumberedCamera& camera, const Square& covariance) {
  ParameterSigmas s;
  s.place_m = camera.frame.distance_m * root_of(covariance, kPlace, 3);
  s.pointing_rad = root_of(covariance, kTurn, 2);
  s.roll_rad = root_of(covariance, kTurn + 2, 1);
  s.scale = root_of(covariance, kScale, 1);
  s.centre_px = camera.frame.focal_px * root_of(covariance, kCentre, 2);
  return s;
}

void remark_on_numbers(const AdjustedCamera& c, const Square& covariance,
                       std::vector<std::string>& remarks) {
  const auto held = [&](int from, int count) {
    for (int i = from; i < from + count; ++i) {
      const double prior = c.priors.sigma[static_cast<std::size_t>(i)];
      if (is_free(c.camera.kind, i) && prior > 0.0 &&
          std::sqrt(covariance(i, i)) > kHeldByPrior * prior) {
        return true;
      }
    }
    return false;
  };
  const double px = c.camera.frame.focal_px;
  if (held(kCentre, 2)) {
    remarks.push_back(fmt::format(
        "the dots hardly tell where its principal point is: held near the image's middle (+-{:.0f} "
        "px)",
        px * c.priors.sigma[kCentre]));
  }
  if (held(kAspect, 1))
    remarks.emplace_back("the dots hardly tell its pixels' shape: taken square");
  if (held(kScale, 1)) {
    remarks.emplace_back(
        "its dots are in one plane that it looks at straight on: focal length held at that of the "
        "approximate model");
  }
  if (held(kAxis, 2)) {
    remarks.emplace_back(
        "the dots hardly tell its lens's axis: held near the image plane's normal");
  }
}

void remark_on_model(const CameraCalibration& c, std::vector<std::string>& remarks) {
  if (c.coverage < kPoorCoverage) {
    remarks.push_back(
        fmt::format("its dots fill only {:.0f} % of the image: outside of them the "
                    "model is extrapolated",
                    100.0 * c.coverage));
  }
  for (const double x : {0.0, c.width_px - 1.0}) {
    for (const double y : {0.0, c.height_px - 1.0}) {
      geometry::Ray ray;
      if (unproject(c.model, {x, y}, ray) == geometry::OpticsStatus::ok) continue;
      remarks.emplace_back("the model's lens ends within the image: its corners see nothing");
      return;
    }
  }
}

class Teller {
 public:
  Teller(std::span<const SurveyedDot> dots, std::span<const CameraViews> views, const Finished& f)
      : dots_(dots), views_(views), f_(f) {}

  Calibration tell() {
    out_.survey_scale = f_.adjustment.survey_scale;
    tell_dots();
    for (std::size_t i = 0; i < views_.size(); ++i) out_.cameras.push_back(camera(i));
    tell_residuals();
    for (CameraCalibration& c : out_.cameras) finish(c);
    tell_joint_covariance();
    tell_hold_out();
    return std::move(out_);
  }

 private:
  void tell_dots() {
    const Surprises all = surprises(f_.adjustment, f_.information);
    for (std::size_t j = 0; j < dots_.size(); ++j) {
      const AdjustedDot& dot = f_.adjustment.dots[j];
      out_.dots.push_back({dot.position_m(), f_.information.dots[j], 0});
      if (dot.trusted) continue;
      out_.suspects.push_back({j, dots_[j].name, dot.offset_m, as_sigmas(all.surveys[j])});
    }
    for (const View& view : f_.adjustment.views) out_.dots[view.dot].views += view.kept ? 1 : 0;
    std::stable_sort(out_.suspects.begin(), out_.suspects.end(),
                     [](const SuspectDot& a, const SuspectDot& b) { return a.sigmas > b.sigmas; });
  }

  CameraCalibration camera(std::size_t i) const {
    const AdjustedCamera& c = f_.adjustment.cameras[i];
    const Square& covariance = f_.information.cameras[i];
    CameraCalibration out;
    out.name = views_[i].name;
    out.width_px = views_[i].width_px;
    out.height_px = views_[i].height_px;
    out.model = model_of(c.camera);
    const MatrixXd jacobian = vectors_jacobian(c.camera);
    const MatrixXd propagated = jacobian * covariance * jacobian.transpose();
    out.covariance = 0.5 * (propagated + propagated.transpose());
    out.chosen = kind_of(c.camera.kind);
    for (const TriedKind& tried : f_.choices[i].tried) {
      out.tried.push_back({words_of(tried.kind), static_cast<std::size_t>(count_free(tried.kind)),
                           tried.holdout_rms_px, tried.chosen});
    }
    out.sigmas = sigmas_of(c.camera, covariance);
    remark_on_numbers(c, covariance, out.remarks);
    return out;
  }

  void tell_joint_covariance() {
    const auto count = static_cast<Eigen::Index>(f_.adjustment.cameras.size());
    MatrixXd by_numbers(0, count * kNumbers);
    for (Eigen::Index i = 0; i < count; ++i) {
      const MatrixXd jacobian =
          vectors_jacobian(f_.adjustment.cameras[static_cast<std::size_t>(i)].camera);
      const Eigen::Index first = by_numbers.rows();
      by_numbers.conservativeResize(first + jacobian.rows(), Eigen::NoChange);
      by_numbers.bottomRows(jacobian.rows()).setZero();
      by_numbers.block(first, i * kNumbers, jacobian.rows(), kNumbers) = jacobian;
    }
    const MatrixXd joint = by_numbers * f_.information.together * by_numbers.transpose();
    out_.joint_covariance = 0.5 * (joint + joint.transpose());
  }

  Vector2d off(const View& view, const Vector3d& point, bool& seen) const {
    Vector2d pixel;
    seen = project(out_.cameras[view.camera].model, point, pixel) == geometry::OpticsStatus::ok;
    return seen ? Vector2d(view.pixel - pixel) : Vector2d(Vector2d::Zero());
  }

  void tell_residuals() {
    for (std::size_t i = 0; i < f_.adjustment.views.size(); ++i) {
      const View& view = f_.adjustment.views[i];
      const AdjustedDot& dot = f_.adjustment.dots[view.dot];
      ResidualOfView r;
      r.dot = view.dot;
      r.pixel = view.pixel;
      bool seen = false;
      bool seen_adjusted = false;
      r.off_px = off(view, dot.surveyed_m, seen);
      r.off_adjusted_px = off(view, dot.position_m(), seen_adjusted);
      r.used = view.kept && seen && seen_adjusted;
      if (f_.held_out.off_px[i]) {
        r.holdout_px = *f_.held_out.off_px[i];
        if (r.used && dot.trusted) {
          holdout_px_.add(r.holdout_px.squaredNorm());
        }
      }
      CameraCalibration& c = out_.cameras[view.camera];
      c.residuals.push_back(r);
      c.image_sigma_px += f_.adjustment.sigma_px(view);
    }
  }

  void finish(CameraCalibration& c) const {
    Rms surveyed;
    Rms adjusted;
    Rms held_out;
    std::vector<Vector2d> pixels;
    std::size_t left_out = 0;
    for (const ResidualOfView& r : c.residuals) {
      if (!r.used) {
        ++left_out;
        continue;
      }
      pixels.push_back(r.pixel);
      adjusted.add(r.off_adjusted_px.squaredNorm());
      if (!f_.adjustment.dots[r.dot].trusted) continue;
      surveyed.add(r.off_px.squaredNorm());
      held_out.add(r.holdout_px.squaredNorm());
    }
    c.rms_px = surveyed.value();
    c.rms_adjusted_px = adjusted.value();
    c.holdout_rms_px = held_out.value();
    c.image_sigma_px /= static_cast<double>(std::max<std::size_t>(c.residuals.size(), 1));
    c.hull_px = hull_of(std::move(pixels));
    c.coverage = area_of(c.hull_px) / (static_cast<double>(c.width_px) * c.height_px);
    if (left_out > 0) {
      c.remarks.push_back(fmt::format("{} of its {} views of dots do not fit and were left out",
                                      left_out, c.residuals.size()));
    }
    remark_on_model(c, c.remarks);
  }

  void tell_hold_out() {
    Rms metres;
    for (std::size_t j = 0; j < dots_.size(); ++j) {
      const auto& off_m = f_.held_out.off_m[j];
      if (off_m && f_.adjustment.dots[j].trusted) metres.add(off_m->squaredNorm());
    }
    out_.holdout_rms_px = holdout_px_.value();
    out_.holdout_rms_m = metres.value();
    out_.holdout_dots = metres.count();
  }

  std::span<const SurveyedDot> dots_;
  std::span<const CameraViews> views_;
  const Finished& f_;
  Calibration out_;
  Rms holdout_px_;
};

}  // namespace

Calibration results_of(std::span<const SurveyedDot> dots, std::span<const CameraViews> views,
                       const Finished& finished) {
  return Teller(dots, views, finished).tell();
}

}  // namespace dottrack::calibrate
