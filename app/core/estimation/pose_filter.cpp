#include "app/core/estimation/pose_filter.h"

#include <algorithm>

#include "app/core/estimation/innovation_gate.h"

namespace dottrack::estimation {
namespace {

using TickViews = StaticVector<PoseInformation, kMaxCameras>;

// A longer time passes in steps, in each of which the way of moving may change once.
constexpr double kLongestStep_s = 0.125;
constexpr int kMostSteps = 16;

void let_pass(double seconds, MotionMixture& mixture) {
  if (seconds <= 0.0) return;
  const double hold_s = std::clamp(seconds, kAccelerationHolds_s, kLongestHold_s);
  for (int i = 1; i < kMostSteps && seconds > kLongestStep_s; ++i) {
    mixture.pass(kLongestStep_s, hold_s);
    seconds -= kLongestStep_s;
  }
  mixture.pass(seconds, hold_s);
}

double spread(double limit) {
  return 0.25 * limit * limit;  // half of the limit is one standard deviation, per axis
}

// Views of before `now`, as they would be now had the vehicle moved as it seems to.
PoseInformation carried_on(PoseInformation views, const MotionState& now) {
  if (views.captured >= now.at) return views;
  MotionState then = now;
  advance(MotionModel::steady, {}, to_seconds(views.captured - now.at), then);
  views.position_m += now.position_m - then.position_m;
  views.orientation = now.orientation * then.orientation.conjugate() * views.orientation;
  views.captured = now.at;
  return views;
}

struct Order {
  std::array<std::size_t, kMaxCameras> index{};
  std::size_t size = 0;
};

Order by_capture(std::span<const PoseInformation> cameras) {
  Order order;
  order.size = std::min(cameras.size(), kMaxCameras);
  for (std::size_t i = 0; i < order.size; ++i) order.index[i] = i;
  std::sort(order.index.begin(), order.index.begin() + static_cast<std::ptrdiff_t>(order.size),
            [&](std::size_t a, std::size_t b) {
              return cameras[a].captured < cameras[b].captured ||
                     (cameras[a].captured == cameras[b].captured && a < b);
            });
  return order;
}

// Each camera's views beside what is expected of their time, when the vehicle goes on as `state`.
ExpectedCameras beside_expected(const TickViews& tick, MotionState& state,
                                const core::MotionLimits& limits) {
  ExpectedCameras expected;
  for (const PoseInformation& views : tick) {
    advance(MotionModel::driven, limits, to_seconds(views.captured - state.at), state);
    expected.push_back({views, gradient_at(state, views), state.covariance.topLeftCorner<6, 6>()});
  }
  return expected;
}

Reach reach_of(const MotionState& last, const MotionState& expected) {
  return {difference(expected, last).head<6>(), last.covariance.topLeftCorner<6, 6>(),
          to_seconds(expected.at - last.at)};
}

// Cameras of one capture time are taken in together, which is the same and costs less.
void take_in_all(const TickViews& tick, CameraSet accepted, Time now, MotionMixture& mixture) {
  std::size_t i = 0;
  while (i < tick.size()) {
    PoseInformation sum{.captured = tick[i].captured,
                        .position_m = tick[i].position_m,
                        .orientation = tick[i].orientation};
    for (; i < tick.size() && tick[i].captured == sum.captured; ++i) {
      if (accepted.contains(i)) add(tick[i], sum);
    }
    mixture.drift(to_seconds(sum.captured - now));
    now = sum.captured;
    if (sum.coordinates > 0) mixture.take_in(sum);
  }
  mixture.weigh();
}

}  // namespace

void PoseFilter::start(const core::Pose& pose, Time captured) {
  MotionState state;
  state.at = captured;
  state.position_m = pose.position_m;
  state.orientation = pose.orientation;
  state.covariance.topLeftCorner<6, 6>() = pose.covariance;
  state.covariance.diagonal().head<3>().array() += kTremor_m * kTremor_m;  // never singular
  state.covariance.diagonal().segment<3>(3).array() += kTremor_rad * kTremor_rad;
  state.covariance.diagonal().segment<3>(6).setConstant(spread(limits_.max_speed_m_s));
  state.covariance.diagonal().segment<3>(9).setConstant(spread(limits_.max_turn_rate_rad_s));
  mixture_ = MotionMixture(state, limits_);
  last_ = state;
  running_ = true;
}

UpdateResult PoseFilter::update(std::span<const PoseInformation> cameras) {
  UpdateResult result;
  if (!running_ || cameras.empty()) return result;
  const Order order = by_capture(cameras);
  TickViews tick;
  for (std::size_t i = 0; i < order.size; ++i) {
    tick.push_back(carried_on(cameras[order.index[i]], last_));
  }
  MotionMixture next = mixture_;
  const Time first = tick.front().captured;
  let_pass(to_seconds(first - last_.at), next);
  MotionState expected = next.mean();
  expected.at = first;
  const ExpectedCameras beside = beside_expected(tick, expected, limits_);
  const Judgement judgement = judge(beside, reach_of(last_, expected), limits_);
  for (std::size_t i = 0; i < order.size; ++i) {
    result.surprise[order.index[i]] = judgement.surprise[i];
    if (judgement.accepted.contains(i)) result.accepted.insert(order.index[i]);
  }
  result.jumped = judgement.jumped;
  if (result.accepted.empty()) return result;
  take_in_all(tick, judgement.accepted, first, next);
  mixture_ = next;
  last_ = mixture_.mean();
  last_.at = tick.back().captured;
  return result;
}

MotionState PoseFilter::at(Time time) const {
  const double seconds = to_seconds(time - last_.at);
  MotionState state = last_;
  if (seconds > 0.0) {
    MotionMixture later = mixture_;
    let_pass(seconds, later);
    state = later.mean();
  } else {
    advance(MotionModel::driven, limits_, seconds, state);
  }
  state.at = time;
  return state;
}

core::Motion motion_of(const MotionState& state) {
  return {.known = true, .velocity_m_s = state.velocity_m_s, .rates_rad_s = state.rates_rad_s};
}

}  // namespace dottrack::estimation
