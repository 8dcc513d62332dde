#include "app/core/exposure/iris_loop.h"

#include <algorithm>

namespace dottrack::exposure {
namespace {

constexpr double kStep = 1.15;          // of the opening
constexpr double kLeastStep = 0.005;    // that is a movement at all
constexpr double kTellingStep = 1.07;   // that the images must show
constexpr double kLeastResponse = 0.3;  // of what a movement should change
constexpr int kContradictions = 2;
constexpr int kLongestMove_ticks = 300;
constexpr int kLongestSettling_ticks = 15;
constexpr int kRetry_ticks = 600;

}  // namespace

IrisOrder IrisLoop::take_over(const IrisView& view) {
  if (retry_ticks_ > 0) {
    --retry_ticks_;
    return {};
  }
  fault_ = false;
  contradictions_ = 0;
  phase_ = Phase::resting;
  ended_ = IrisWish::none;
  return {IrisAct::move, view.opening};
}

IrisOrder IrisLoop::give_back() {
  fault_ = true;
  phase_ = Phase::resting;
  retry_ticks_ = kRetry_ticks;
  return {IrisAct::release, 0.0};
}

IrisOrder IrisLoop::begin(const IrisView& view, IrisWish wish, double light) {
  if (wish == IrisWish::none || wish == ended_) return {};
  ended_ = IrisWish::none;
  wish_ = wish;
  opening_before_ = view.opening;
  light_before_ = light;
  phase_ = Phase::moving;
  phase_ticks_ = 0;
  const double wanted = wish == IrisWish::open ? kStep * view.opening : view.opening / kStep;
  return {IrisAct::move, std::min(wanted, 1.0)};
}

// Whether the light followed the iris, or the movement was too small to tell.
bool IrisLoop::judge(double opened, double brightened) {
  if (opened > 1.0) {
    if (opened < kTellingStep) return true;
    return brightened > 1.0 + kLeastResponse * (opened - 1.0);
  }
  if (opened * kTellingStep > 1.0) return true;
  return brightened < 1.0 - kLeastResponse * (1.0 - opened);
}

void IrisLoop::end(const IrisView& view, double light) {
  phase_ = Phase::resting;
  const double moved = view.opening - opening_before_;
  if (moved < kLeastStep && moved > -kLeastStep) {
    ended_ = wish_;
    return;
  }
  if (!(light > 0.0 && light_before_ > 0.0 && opening_before_ > 0.0)) return;
  const bool followed = judge(view.opening / opening_before_, light / light_before_);
  contradictions_ = followed ? 0 : contradictions_ + 1;
}

IrisOrder IrisLoop::step(const IrisView& view, IrisWish wish, double light, int delay_ticks) {
  if (!present_) return {};
  if (!view.healthy) {
    fault_ = true;
    return {};
  }
  if (view.automatic) return take_over(view);
  if (contradictions_ == 0) fault_ = false;
  ++phase_ticks_;
  switch (phase_) {
    case Phase::resting:
      return view.moving ? IrisOrder{} : begin(view, wish, light);
    case Phase::moving:
      if (view.moving) return phase_ticks_ > kLongestMove_ticks ? give_back() : IrisOrder{};
      phase_ = Phase::settling;
      phase_ticks_ = 0;
      return {};
    case Phase::settling:
      if (phase_ticks_ < delay_ticks) return {};
      if (!(light > 0.0) && phase_ticks_ < kLongestSettling_ticks) return {};
      end(view, light);
      return contradictions_ >= kContradictions ? give_back() : IrisOrder{};
  }
  return {};
}

}  // namespace dottrack::exposure
