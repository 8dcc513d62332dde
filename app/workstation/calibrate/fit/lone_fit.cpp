#include "app/workstation/calibrate/fit/lone_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/workstation/calibrate/fit/chi_square.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;

constexpr int kRounds = 3;

Adjustment alone(const AdjustedCamera& camera, std::span<const View> views,
                 std::span<const AdjustedDot> dots) {
  Adjustment out;
  out.cameras.push_back(camera);
  for (const View& view : views) {
    View own = view;
    own.camera = 0;
    own.dot = out.dots.size();
    out.views.push_back(own);
    out.dots.push_back(dots[view.dot]);
  }
  return out;
}

// Squared sigmas of a view of a dot where it was surveyed.
double squared_sigmas(const Adjustment& a, const View& view) {
  const AdjustedDot& dot = a.dots[view.dot];
  const auto linear = linear_view(a.cameras[0].camera, dot.surveyed_m);
  if (!linear) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d variance = (a.survey_scale * dot.sigma_m).array().square().matrix();
  const double sigma_px = a.sigma_px(view);
  const Eigen::Matrix2d covariance =
      linear->by_point * variance.asDiagonal() * linear->by_point.transpose() +
      sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  const Vector2d off = linear->pixel - view.pixel;
  return off.dot(covariance.inverse() * off);
}

double median_squared_sigmas(const Adjustment& a) {
  std::vector<double> all;
  for (const View& view : a.views) all.push_back(squared_sigmas(a, view));
  const auto middle = all.begin() + static_cast<long>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

}  // namespace

std::optional<LoneFit> fit_alone(const AdjustedCamera& camera, std::span<const View> views,
                                 std::span<const AdjustedDot> dots) {
  Adjustment a = alone(camera, views, dots);
  double scale = 1.0;
  // A camera noisier or a survey worse than claimed would drown in the robust losses.
  const auto rescale = [&] {
    const double middle = median_squared_sigmas(a);
    if (!std::isfinite(middle)) return false;
    const double factor = std::sqrt(std::max(middle, 1e-6) / kMedian2);
    a.cameras[0].image_scale *= factor;
    a.survey_scale *= factor;
    scale *= factor;
    return true;
  };
  for (int i = 0; i < kRounds; ++i) {
    if (!rescale()) return std::nullopt;
    for (AdjustedDot& dot : a.dots) dot.offset_m.setZero();
    if (!solve(a, i == 0 ? Loss::cauchy : Loss::huber, Precision::rough)) return std::nullopt;
  }
  if (!rescale()) return std::nullopt;
  return LoneFit{a.cameras[0].camera, scale};
}

}  // namespace dottrack::calibrate
