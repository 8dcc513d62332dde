#include "app/workstation/calibrate/labelling/sketch.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/core/geometry/camera_model.h"

namespace dottrack::calibrate {
namespace {

constexpr int kUnknowns = 12;  // rotation, translation, log f, log a, centre, k1, k2
using Row = Eigen::Matrix<double, 1, kUnknowns>;
using Step = Eigen::Matrix<double, kUnknowns, 1>;
using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;

// Where the distorted radius no longer rises.
bool folds(const Sketch& s, double tau) {
  return 1.0 + 3.0 * s.k1 * tau + 5.0 * s.k2 * tau * tau <= 0.05;
}

struct Linearised {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, kUnknowns> jacobian;
};

std::optional<Linearised> linearised(const Sketch& s, const Eigen::Vector3d& p) {
  const Eigen::Vector3d turned = s.rotation * p;
  const Eigen::Vector3d q = turned + s.translation_m;
  if (!(q.z() > 1e-9)) return std::nullopt;
  const Eigen::Vector2d u = q.head<2>() / q.z();
  const double tau = u.squaredNorm();
  if (folds(s, tau)) return std::nullopt;
  const double m = 1.0 + s.k1 * tau + s.k2 * tau * tau;
  const double slope = s.k1 + 2.0 * s.k2 * tau;  // dm/dtau
  const Eigen::Vector2d scale(s.focal_px, s.focal_px * s.aspect);
  Linearised l;
  const Eigen::Vector2d ideal = m * u;
  l.pixel = scale.cwiseProduct(ideal) + s.centre_px;
  const Eigen::Matrix2d by_u =
      scale.asDiagonal() * (m * Eigen::Matrix2d::Identity() + 2.0 * slope * u * u.transpose());
  Eigen::Matrix<double, 2, 3> by_q;
  by_q << by_u / q.z(), -(by_u * u) / q.z();
  Eigen::Matrix3d cross;  // d(exp(w) R p) = -[R p] w
  cross << 0, turned.z(), -turned.y(), -turned.z(), 0, turned.x(), turned.y(), -turned.x(), 0;
  l.jacobian.leftCols<3>() = by_q * cross;
  l.jacobian.middleCols<3>(3) = by_q;
  l.jacobian.col(6) = scale.cwiseProduct(ideal);
  l.jacobian.col(7) = Eigen::Vector2d(0.0, scale.y() * ideal.y());
  l.jacobian.middleCols<2>(8) = Eigen::Matrix2d::Identity();
  l.jacobian.col(10) = tau * scale.cwiseProduct(u);
  l.jacobian.col(11) = tau * tau * scale.cwiseProduct(u);
  return l;
}

Eigen::Matrix3d turned_by(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle < 1e-15) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Sketch moved(const Sketch& s, const Step& step) {
  Sketch next = s;
  next.rotation = turned_by(step.head<3>()) * s.rotation;
  next.translation_m += step.segment<3>(3);
  next.focal_px *= std::exp(std::clamp(step[6], -0.7, 0.7));
  next.aspect *= std::exp(std::clamp(step[7], -0.1, 0.1));
  next.centre_px += step.segment<2>(8);
  next.k1 += step[10];
  next.k2 += step[11];
  return next;
}

class Problem {
 public:
  Problem(const SketchPrior& prior, std::span<const Eigen::Vector3d> points,
          std::span<const Eigen::Vector2d> pixels, double scale_px)
      : prior_(prior), points_(points), pixels_(pixels), scale2_(scale_px * scale_px) {}

  double cost(const Sketch& s) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto pixel = project(s, points_[i]);
      sum += pixel ? loss((*pixel - pixels_[i]).squaredNorm()) : kUnseen;
    }
    for_prior(s, [&](int, double error, double sigma) {
      sum += 0.5 * (error / sigma) * (error / sigma);
    });
    for_place(s, [&](const Eigen::Vector3d& error, const Eigen::Matrix<double, 3, 6>&) {
      sum += 0.5 * error.squaredNorm();
    });
    return sum;
  }

  void linearise(const Sketch& s, Normal& normal, Step& gradient) const {
    normal.setZero();
    gradient.setZero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto l = linearised(s, points_[i]);
      if (!l) continue;
      const Eigen::Vector2d error = l->pixel - pixels_[i];
      const double weight = 1.0 / (scale2_ + error.squaredNorm());
      normal.noalias() += weight * l->jacobian.transpose() * l->jacobian;
      gradient.noalias() += weight * l->jacobian.transpose() * error;
    }
    for_prior(s, [&](int i, double error, double sigma) {
      normal(i, i) += 1.0 / (sigma * sigma);
      gradient[i] += error / (sigma * sigma);
    });
    for_place(s, [&](const Eigen::Vector3d& error, const Eigen::Matrix<double, 3, 6>& jacobian) {
      normal.topLeftCorner<6, 6>() += jacobian.transpose() * jacobian;
      gradient.head<6>() += jacobian.transpose() * error;
    });
  }

 private:
  static constexpr double kUnseen = 6.0;

  // Cauchy's: of a pair's squared distance.
  double loss(double squared) const { return 0.5 * std::log1p(squared / scale2_); }

  template <class Take>
  void for_prior(const Sketch& s, Take take) const {
    const Sketch& b = prior_.about;
    take(6, std::log(s.focal_px / b.focal_px), prior_.log_focal);
    take(7, std::log(s.aspect / b.aspect), prior_.log_aspect);
    take(8, s.centre_px.x() - b.centre_px.x(), prior_.centre_px);
    take(9, s.centre_px.y() - b.centre_px.y(), prior_.centre_px);
    take(10, s.k1 - b.k1, prior_.distortion);
    take(11, s.k2 - b.k2, prior_.distortion);
    if (prior_.rotation_rad <= 0.0) return;
    const Eigen::AngleAxisd off(Eigen::Matrix3d(s.rotation * b.rotation.transpose()));
    for (int i = 0; i < 3; ++i) take(i, off.angle() * off.axis()[i], prior_.rotation_rad);
  }

  // C = -R^T t: dC = -R^T (dt + [t] w), in units of its sigma.
  template <class Take>
  void for_place(const Sketch& s, Take take) const {
    if (prior_.place_m <= 0.0) return;
    const Eigen::Vector3d error = (s.place_m() - prior_.about.place_m()) / prior_.place_m;
    const Eigen::Vector3d& t = s.translation_m;
    Eigen::Matrix3d cross;
    cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian.leftCols<3>() = -s.rotation.transpose() * cross / prior_.place_m;
    jacobian.rightCols<3>() = -s.rotation.transpose() / prior_.place_m;
    take(error, jacobian);
  }

  const SketchPrior& prior_;
  std::span<const Eigen::Vector3d> points_;
  std::span<const Eigen::Vector2d> pixels_;
  double scale2_;
};

double median_distance(const Sketch& s, std::span<const Eigen::Vector3d> points,
                       std::span<const Eigen::Vector2d> pixels) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = project(s, points[i]);
    distances.push_back(pixel ? (*pixel - pixels[i]).norm() : 1e9);
  }
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

std::optional<Eigen::Vector2d> project(const Sketch& s, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d q = s.rotation * p_world + s.translation_m;
  if (!(q.z() > 1e-9)) return std::nullopt;
  const Eigen::Vector2d u = q.head<2>() / q.z();
  const double tau = u.squaredNorm();
  if (folds(s, tau)) return std::nullopt;
  const double scale = s.focal_px * (1.0 + s.k1 * tau + s.k2 * tau * tau);
  return Eigen::Vector2d(scale * u.x(), scale * s.aspect * u.y()) + s.centre_px;
}

geometry::Cahvor as_cahvor(const Sketch& s) {
  geometry::Cahvor model;
  model.c = s.place_m();
  model.a = s.rotation.row(2).transpose();
  model.h = s.focal_px * s.rotation.row(0).transpose() + s.centre_px.x() * model.a;
  model.v = s.focal_px * s.aspect * s.rotation.row(1).transpose() + s.centre_px.y() * model.a;
  model.o = model.a;
  model.r = {0.0, s.k1, s.k2};
  return model;
}

Sketch as_sketch(const geometry::CameraModel& model) {
  Sketch s;
  const auto take = [&](const auto& m) {
    s.centre_px = {m.h.dot(m.a), m.v.dot(m.a)};
    const Eigen::Vector3d right = m.h - s.centre_px.x() * m.a;
    const Eigen::Vector3d down = m.v - s.centre_px.y() * m.a;
    s.focal_px = right.norm();
    s.aspect = down.norm() / s.focal_px;
    s.rotation.row(0) = right.normalized();
    s.rotation.row(2) = m.a.normalized();
    s.rotation.row(1) = s.rotation.row(2).cross(s.rotation.row(0));
    s.translation_m = -(s.rotation * m.c);
  };
  std::visit(take, model);
  geometry::Cahvor cahvor;
  if (geometry::as_cahvor(model, cahvor)) {
    const double whole = 1.0 + cahvor.r.x();
    s.focal_px *= whole;
    s.k1 = cahvor.r.y() / whole;
    s.k2 = cahvor.r.z() / whole;
  }
  return s;
}

SketchPrior any_camera(int width_px, int height_px) {
  SketchPrior prior;
  prior.about.focal_px = 1.5 * width_px;
  prior.about.centre_px = {0.5 * (width_px - 1), 0.5 * (height_px - 1)};
  prior.centre_px = width_px / 7.0;
  return prior;
}

SketchFit fit_sketch(const Sketch& start, const SketchPrior& prior,
                     std::span<const Eigen::Vector3d> points,
                     std::span<const Eigen::Vector2d> pixels, double scale_px, int steps) {
  const Problem problem(prior, points, pixels, scale_px);
  SketchFit fit{start, problem.cost(start), 0.0};
  Normal normal;
  Step gradient;
  double damping = 1e-4;
  for (int i = 0; i < steps && damping < 1e8; ++i) {
    problem.linearise(fit.sketch, normal, gradient);
    bool better = false;
    double gained = 0.0;
    for (; !better && damping < 1e8; damping *= better ? 0.1 : 10.0) {
      Normal damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Step step = damped.ldlt().solve(-gradient);
      if (!step.allFinite()) continue;
      const Sketch next = moved(fit.sketch, step);
      const double cost = problem.cost(next);
      better = cost < fit.cost;
      if (!better) continue;
      gained = fit.cost - cost;
      fit.sketch = next;
      fit.cost = cost;
    }
    if (gained < 1e-6 * (1.0 + fit.cost)) break;
  }
  fit.spread_px = median_distance(fit.sketch, points, pixels);
  return fit;
}

}  // namespace dottrack::calibrate
