#include "app/core/estimation/motion_mixture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dottrack::estimation {
namespace {

// Of a vehicle that nothing is known of but that it is not being struck right now.
constexpr std::array<double, kMotionModels> kAtFirst{0.25, 0.25, 0.25, 0.25, 0.0};

// What weighs less does not change a sum.
constexpr double kNegligible = 1e-15;

}  // namespace

MotionMixture::MotionMixture(const MotionState& state, const core::MotionLimits& limits)
    : limits_(limits), weights_(kAtFirst) {
  states_.fill(state);
}

void MotionMixture::pass(double seconds, double hold_s) {
  switch_models(seconds);
  drift(seconds, hold_s);
}

void MotionMixture::drift(double seconds, double hold_s) {
  for (std::size_t i = 0; i < kMotionModels; ++i) {
    advance(static_cast<MotionModel>(i), limits_, seconds, states_[i], hold_s);
  }
}

void MotionMixture::take_in(const PoseInformation& views) {
  for (std::size_t i = 0; i < kMotionModels; ++i) {
    log_likelihoods_[i] += estimation::take_in(views, states_[i]);
  }
}

void MotionMixture::weigh() {
  const double best = *std::max_element(log_likelihoods_.begin(), log_likelihoods_.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < kMotionModels; ++i) {
    weights_[i] *= std::exp(log_likelihoods_[i] - best);
    sum += weights_[i];
  }
  for (double& weight : weights_) weight /= sum;
  log_likelihoods_.fill(0.0);
}

void MotionMixture::switch_models(double seconds) {
  const ModelTable table = switching(seconds);
  const MotionState origin = most_probable();
  const Steps steps = steps_from(origin);
  Weights after{};
  std::array<MotionState, kMotionModels> mixed;
  for (std::size_t to = 0; to < kMotionModels; ++to) {
    Weights shares{};
    for (std::size_t from = 0; from < kMotionModels; ++from) {
      shares[from] = table[from][to] * weights_[from];
    }
    after[to] = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= after[to];
    mixed[to] = blend(shares, steps, origin);
  }
  states_ = mixed;
  weights_ = after;
}

MotionState MotionMixture::blend(const Weights& weights, const Steps& steps,
                                 const MotionState& origin) const {
  Vector12d mean = Vector12d::Zero();
  for (std::size_t i = 0; i < kMotionModels; ++i) mean += weights[i] * steps[i];
  MotionState blended = origin;
  blended.covariance.setZero();
  for (std::size_t i = 0; i < kMotionModels; ++i) {
    if (weights[i] < kNegligible) continue;
    const Vector12d off = steps[i] - mean;
    const Vector12d scaled = weights[i] * off;
    blended.covariance += weights[i] * states_[i].covariance;
    blended.covariance += scaled * off.transpose();
  }
  blended.covariance = 0.5 * (blended.covariance + blended.covariance.transpose()).eval();
  move_by(mean, blended);
  return blended;
}

MotionMixture::Steps MotionMixture::steps_from(const MotionState& origin) const {
  Steps steps;
  for (std::size_t i = 0; i < kMotionModels; ++i) steps[i] = difference(states_[i], origin);
  return steps;
}

const MotionState& MotionMixture::most_probable() const {
  const auto best = std::max_element(weights_.begin(), weights_.end());
  return states_[static_cast<std::size_t>(best - weights_.begin())];
}

MotionState MotionMixture::mean() const {
  const MotionState& origin = most_probable();
  return blend(weights_, steps_from(origin), origin);
}

}  // namespace dottrack::estimation
