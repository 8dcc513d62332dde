#pragma once
// The pose from every view of every dot at once: what the paper's triangulation and fit forget of
// the rays is kept here (after its sections 3.2.3 and 3.2.4, which give the start).

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "app/core/estimation/dot_spread.h"
#include "app/core/estimation/lasting_share.h"
#include "app/core/estimation/robust_step.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::estimation {

// How a view fits the pose, observation by observation.
struct FittedView {
  bool used = false;
  double residual_px = 0.0;  // distance
  double normalised = 0.0;   // root of half the squared residual in its own variance: 1 on average
};

// What one camera's used views say of the pose: normal equations of a small step from it.
struct CameraEvidence {
  NormalEquations normal;
  int coordinates = 0;
};

struct PoseFit {
  core::Pose pose;  // its rms_residual_m is not set
  // The part of its covariance that comes from the camera models (S of their files) and from the
  // dots' places on the target. It stays the same from tick to tick: no filter averages it out.
  Matrix6d systematic = Matrix6d::Zero();
  StaticVector<FittedView, kMaxCameras * core::kMaxDots> views;        // as given
  StaticVector<ViewResidual, kMaxCameras * core::kMaxDots> residuals;  // of the views used
  int coordinates = 0;  // of the views used: two each
  double chi2 = 0.0;    // of them, in their own variances
  std::array<CameraEvidence, kMaxCameras> cameras;
  SpreadEvidence spread;     // of the dots about their places, as far as these views show it
  double dot_sigma_m = 0.0;  // of a dot's place, each coordinate, as the covariance has it
};

enum class PoseFitStatus : std::uint8_t {
  ok,
  too_few_views,  // fewer than six coordinates
  degenerate,     // they do not determine a pose
};

// Gauss-Newton over the reprojections of the dots, position and rotation together, with a bounded
// number of linearisations; wrong views are left out (robust_step). The covariance is what the
// views' own covariances and the models' imply, true as long as those are; where the residuals are
// larger than chance explains, it is scaled up by as much. Cameras may see the dots at different
// instants. The pose is that of the instant that CaptureTimes counts from.
//
// Dots may be off their places by the rig's dot_sigma_m, or by what ticks before have shown where
// that is more: views are weighed so, and anew where the residuals are larger than chance explains
// and these views show the dots to be off by more. The covariance has their evidence in it, too.
class PoseFitter {
 public:
  explicit PoseFitter(const core::Rig& rig) : rig_(&rig) {}  // outlives the object

  PoseFitStatus fit(std::span<const DotObservation> views, const CaptureTimes& times,
                    const geometry::RigidMotion& start, const DotSpread& spread, PoseFit& result);

 private:
  double place_variance_m2(double learnt_m2) const;
  PoseFitStatus solve(std::span<const DotObservation> views, const CaptureTimes& times,
                      double dot_variance_m2, geometry::RigidMotion& pose);
  void report(std::span<const DotObservation> views, const geometry::RigidMotion& pose,
              const DotSpread& spread, double assumed_m2, PoseFit& result);

  const core::Rig* rig_;
  Eccentricities offs_px_;
  ViewRows rows_;
  Flags used_{};
};

}  // namespace dottrack::estimation
