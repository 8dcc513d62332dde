#include "app/workstation/calibrate/fit/adjustment.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <memory>

#include "app/workstation/calibrate/fit/numbered_projection.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct ViewCost {
  const CameraFrame* frame;
  LensKind kind;
  Vector3d surveyed_m;
  Vector2d pixel;
  double sigma_px;

  template <class T>
  bool operator()(const T* numbers, const T* offset_m, T* residual) const {
    const Three<T> p(surveyed_m.x() + offset_m[0], surveyed_m.y() + offset_m[1],
                     surveyed_m.z() + offset_m[2]);
    T at[2];
    if (!project_numbered(*frame, kind, numbers, p, at)) return false;
    residual[0] = (at[0] - pixel.x()) / sigma_px;
    residual[1] = (at[1] - pixel.y()) / sigma_px;
    return true;
  }
};

struct SurveyCost {
  Vector3d sigma_m;

  template <class T>
  bool operator()(const T* offset_m, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = offset_m[i] / sigma_m[i];
    return true;
  }
};

struct NumberCost {
  Numbers sigma;  // 0: no matter

  template <class T>
  bool operator()(const T* numbers, T* residual) const {
    for (std::size_t i = 0; i < kNumbers; ++i) {
      residual[i] = sigma[i] > 0.0 ? numbers[i] / sigma[i] : T(0.0);
    }
    return true;
  }
};

using RadialTerms = std::array<double, kRadialTerms>;

struct LikenessCost {
  RadialTerms sigma;  // 0: no matter

  template <class T>
  bool operator()(const T* numbers, const T* lens, T* residual) const {
    for (std::size_t i = 0; i < kRadialTerms; ++i) {
      residual[i] = sigma[i] > 0.0 ? (numbers[kRadial + i] - lens[i]) / sigma[i] : T(0.0);
    }
    return true;
  }
};

struct LensCost {
  RadialTerms sigma;

  template <class T>
  bool operator()(const T* lens, T* residual) const {
    for (std::size_t i = 0; i < kRadialTerms; ++i) residual[i] = lens[i] / sigma[i];
    return true;
  }
};

std::unique_ptr<ceres::LossFunction> loss_function(Loss loss) {
  switch (loss) {
    case Loss::squares:
      return nullptr;
    case Loss::huber:
      return std::make_unique<ceres::HuberLoss>(kHuberSigmas);
    case Loss::cauchy:
      return std::make_unique<ceres::CauchyLoss>(kCauchySigmas);
  }
  return nullptr;
}

std::vector<int> fixed_numbers(const LensKind& kind) {
  std::vector<int> fixed;
  for (int i = 0; i < kNumbers; ++i) {
    if (!is_free(kind, i)) fixed.push_back(i);
  }
  return fixed;
}

// The problem owns its costs; the adjustment's numbers and offsets are solved for in place.
class Bundle {
 public:
  Bundle(Adjustment& adjustment, Loss loss)
      : adjustment_(adjustment), loss_(loss_function(loss)), problem_(options()) {
    add_views();
    add_dots();
    add_cameras();
    if (adjustment_.lens.exists) add_lens();
  }

  bool solve(Precision precision) {
    ceres::Solver::Options options;
    const bool full = precision == Precision::full;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.dense_linear_algebra_library_type = ceres::EIGEN;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (std::size_t i = 0; i < adjustment_.dots.size(); ++i) {
      if (seen_[i]) {
        options.linear_solver_ordering->AddElementToGroup(adjustment_.dots[i].offset_m.data(), 0);
      }
    }
    for (AdjustedCamera& c : adjustment_.cameras) {
      if (problem_.HasParameterBlock(c.camera.numbers.data())) {
        options.linear_solver_ordering->AddElementToGroup(c.camera.numbers.data(), 1);
      }
    }
    if (problem_.HasParameterBlock(adjustment_.lens.radial.data())) {
      options.linear_solver_ordering->AddElementToGroup(adjustment_.lens.radial.data(), 1);
    }
    options.num_threads = 1;
    options.max_num_iterations = full ? 200 : 40;
    options.function_tolerance = full ? 1e-14 : 1e-7;
    options.parameter_tolerance = full ? 1e-11 : 1e-8;
    options.gradient_tolerance = full ? 1e-11 : 1e-8;
    options.max_num_consecutive_invalid_steps = 20;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

 private:
  static ceres::Problem::Options options() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void add_views() {
    seen_.assign(adjustment_.dots.size(), false);
    for (const View& view : adjustment_.views) {
      if (!view.kept) continue;
      AdjustedCamera& c = adjustment_.cameras[view.camera];
      AdjustedDot& dot = adjustment_.dots[view.dot];
      auto* const cost = new ceres::AutoDiffCostFunction<ViewCost, 2, kNumbers, 3>(new ViewCost{
          &c.camera.frame, c.camera.kind, dot.surveyed_m, view.pixel, adjustment_.sigma_px(view)});
      problem_.AddResidualBlock(cost, loss_.get(), c.camera.numbers.data(), dot.offset_m.data());
      seen_[view.dot] = true;
    }
  }

  void add_dots() {
    for (std::size_t i = 0; i < adjustment_.dots.size(); ++i) {
      AdjustedDot& dot = adjustment_.dots[i];
      if (!seen_[i]) {
        dot.offset_m.setZero();
        continue;
      }
      if (!dot.trusted) continue;
      auto* const cost = new ceres::AutoDiffCostFunction<SurveyCost, 3, 3>(
          new SurveyCost{adjustment_.survey_scale * dot.sigma_m});
      problem_.AddResidualBlock(cost, loss_.get(), dot.offset_m.data());
    }
  }

  void add_cameras() {
    for (AdjustedCamera& c : adjustment_.cameras) {
      if (!problem_.HasParameterBlock(c.camera.numbers.data())) continue;
      auto* const cost =
          new ceres::AutoDiffCostFunction<NumberCost, kNumbers, kNumbers>(new NumberCost{own(c)});
      problem_.AddResidualBlock(cost, nullptr, c.camera.numbers.data());
      const std::vector<int> fixed = fixed_numbers(c.camera.kind);
      if (!fixed.empty()) {
        problem_.SetManifold(c.camera.numbers.data(), new ceres::SubsetManifold(kNumbers, fixed));
      }
    }
  }

  // Sigmas of the numbers that are a camera's own.
  Numbers own(const AdjustedCamera& c) const {
    Numbers sigma = c.priors.sigma;
    for (int i = 0; i < kNumbers; ++i) {
      if (adjustment_.shares(c, i)) sigma[static_cast<std::size_t>(i)] = 0.0;
    }
    return sigma;
  }

  void add_lens() {
    double* const lens = adjustment_.lens.radial.data();
    for (AdjustedCamera& c : adjustment_.cameras) {
      if (!problem_.HasParameterBlock(c.camera.numbers.data())) continue;
      RadialTerms sigma{};
      for (std::size_t i = 0; i < kRadialTerms; ++i) {
        if (adjustment_.shares(c, kRadial + static_cast<int>(i))) {
          sigma[i] = c.priors.sigma[kRadial + i];
        }
      }
      using Cost = ceres::AutoDiffCostFunction<LikenessCost, kRadialTerms, kNumbers, kRadialTerms>;
      problem_.AddResidualBlock(new Cost(new LikenessCost{sigma}), nullptr, c.camera.numbers.data(),
                                lens);
    }
    using Cost = ceres::AutoDiffCostFunction<LensCost, kRadialTerms, kRadialTerms>;
    problem_.AddResidualBlock(new Cost(new LensCost{lens_sigma(adjustment_)}), nullptr, lens);
  }

  Adjustment& adjustment_;
  std::unique_ptr<ceres::LossFunction> loss_;
  ceres::Problem problem_;
  std::vector<bool> seen_;
};

bool all_finite(const Adjustment& adjustment) {
  return std::all_of(adjustment.cameras.begin(), adjustment.cameras.end(),
                     [](const AdjustedCamera& c) {
                       return std::all_of(c.camera.numbers.begin(), c.camera.numbers.end(),
                                          [](double n) { return std::isfinite(n); });
                     });
}

}  // namespace

std::array<double, kRadialTerms> lens_sigma(const Adjustment& adjustment) {
  std::array<double, kRadialTerms> sigma{};
  for (const AdjustedCamera& c : adjustment.cameras) {
    for (std::size_t i = 0; i < kRadialTerms; ++i) {
      sigma[i] = std::max(sigma[i], c.priors.loosest[kRadial + i]);
    }
  }
  return sigma;
}

bool solve(Adjustment& adjustment, Loss loss, Precision precision) {
  const bool usable = Bundle(adjustment, loss).solve(precision);
  for (AdjustedCamera& c : adjustment.cameras) rebase(c.camera);
  return usable && all_finite(adjustment);
}

}  // namespace dottrack::calibrate
