#pragma once
// The vehicle's state under each way of moving, and how probable each is: interacting multiple
// models (Blom and Bar-Shalom, IEEE Trans. Automatic Control 33 (8), 1988), on poses.

#include <array>
#include <span>

#include "app/core/estimation/motion_model.h"
#include "app/core/estimation/motion_state.h"
#include "app/core/estimation/pose_information.h"

namespace dottrack::estimation {

class MotionMixture {
 public:
  MotionMixture() = default;
  // All ways of moving alike but for their shares.
  MotionMixture(const MotionState& state, const core::MotionLimits& limits);

  // Some time passes, in which the vehicle may have changed its way of moving.
  void pass(double seconds, double hold_s);
  // Too little time for that.
  void drift(double seconds, double hold_s = kAccelerationHolds_s);

  void take_in(const PoseInformation& views);
  // The probabilities from what has been taken in since the last call.
  void weigh();

  // The mean and the covariance over all ways of moving.
  MotionState mean() const;
  double probability(MotionModel model) const { return weights_[static_cast<std::size_t>(model)]; }

 private:
  using Weights = std::array<double, kMotionModels>;
  using Steps = std::array<Vector12d, kMotionModels>;

  void switch_models(double seconds);
  MotionState blend(const Weights& weights, const Steps& steps, const MotionState& origin) const;
  Steps steps_from(const MotionState& origin) const;
  const MotionState& most_probable() const;

  core::MotionLimits limits_;
  std::array<MotionState, kMotionModels> states_;
  Weights weights_{};
  Weights log_likelihoods_{};
};

}  // namespace dottrack::estimation
