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
constexpr int kExerciseEvery_ticks = 3600;  // two minutes at 30 Hz
constexpr int kExerciseRest_ticks = 30;     // between two of them
constexpr double kLightChanged = 1.5;
// Of the whole way: more than a lens's play, and no more than dots at three quarters of full scale
// bear.
constexpr double kExercise = 0.06;
constexpr double kLeastOpening = 0.35;
constexpr double kHigh = 1.04;  // a level that bears closing best
constexpr double kLow = 0.95;   // and one that does not

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
  exercise_ = Exercise::none;
  light_exercised_ = 0.0;
  return {IrisAct::move, view.opening};
}

IrisOrder IrisLoop::give_back() {
  fault_ = true;
  phase_ = Phase::resting;
  exercise_ = Exercise::none;
  retry_ticks_ = kRetry_ticks;
  return {IrisAct::release, 0.0};
}

IrisOrder IrisLoop::move(const IrisView& view, const IrisLight& light, double opening) {
  opening_before_ = view.opening;
  light_before_ = light;
  phase_ = Phase::moving;
  phase_ticks_ = 0;
  return {IrisAct::move, opening};
}

IrisOrder IrisLoop::begin(const IrisView& view, IrisWish wish, const IrisLight& light) {
  if (wish == IrisWish::none) return exercise(view, light);
  if (wish == ended_) return {};
  ended_ = IrisWish::none;
  wish_ = wish;
  const double wanted = wish == IrisWish::open ? kStep * view.opening : view.opening / kStep;
  return move(view, light, std::min(wanted, 1.0));
}

bool IrisLoop::is_to_exercise(const IrisLight& light) const {
  if (!light.steady || !(light.image > 0.0)) return false;
  if (contradictions_ > 0 || !(light_exercised_ > 0.0)) return true;
  if (idle_ticks_ < kExerciseRest_ticks) return false;
  const double ratio = light.image / light_exercised_;
  return ratio > kLightChanged || ratio * kLightChanged < 1.0 ||
         idle_ticks_ >= kExerciseEvery_ticks;
}

// Towards where the dots keep the most room.
IrisOrder IrisLoop::exercise(const IrisView& view, const IrisLight& light) {
  if (view.opening < kLeastOpening || !is_to_exercise(light)) return {};
  const bool has_room = view.opening + kExercise <= 1.0;
  if (!has_room && light.level < kLow) return {};
  const bool opens = has_room && light.level < kHigh;
  exercise_ = Exercise::out;
  came_from_ = view.opening;
  return move(view, light, opens ? view.opening + kExercise : view.opening - kExercise);
}

// An exercise whose light is not known on the way tells nothing, and goes back all the same.
IrisOrder IrisLoop::go_back(const IrisView& view, const IrisLight& light) {
  out_is_known_ = light.image > 0.0;
  opened_out_ = view.opening / opening_before_;
  brightened_out_ = light.image / light_before_.image;
  exercise_ = Exercise::back;
  return move(view, light, came_from_);
}

void IrisLoop::note(const IrisLight& light) {
  light_exercised_ = light.image;
  idle_ticks_ = 0;
}

void IrisLoop::end_exercise(const IrisView& view, const IrisLight& light) {
  exercise_ = Exercise::none;
  phase_ = Phase::resting;
  if (!out_is_known_ || !(light.image > 0.0)) return;
  note(light);
  const double opened = view.opening / opening_before_ / opened_out_;
  const double brightened = light.image / light_before_.image / brightened_out_;
  if (opened > kTellingStep || opened * kTellingStep < 1.0) count(judge(opened, brightened));
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

void IrisLoop::end(const IrisView& view, const IrisLight& light) {
  phase_ = Phase::resting;
  const double moved = view.opening - opening_before_;
  if (moved < kLeastStep && moved > -kLeastStep) {
    ended_ = wish_;
    return;
  }
  if (!(light.dots > 0.0 && light_before_.dots > 0.0 && opening_before_ > 0.0)) return;
  count(judge(view.opening / opening_before_, light.dots / light_before_.dots));
  if (contradictions_ == 0) note(light);
}

IrisOrder IrisLoop::move_on(const IrisView& view) {
  if (view.moving) return phase_ticks_ > kLongestMove_ticks ? give_back() : IrisOrder{};
  phase_ = Phase::settling;
  phase_ticks_ = 0;
  return {};
}

IrisOrder IrisLoop::settle(const IrisView& view, const IrisLight& light, int delay_ticks) {
  const double told = exercise_ == Exercise::none ? light.dots : light.image;
  if (phase_ticks_ < delay_ticks) return {};
  if (!(told > 0.0) && phase_ticks_ < kLongestSettling_ticks) return {};
  if (exercise_ == Exercise::out) return go_back(view, light);
  if (exercise_ == Exercise::back) {
    end_exercise(view, light);
  } else {
    end(view, light);
  }
  return contradictions_ >= kContradictions ? give_back() : IrisOrder{};
}

IrisOrder IrisLoop::step(const IrisView& view, IrisWish wish, const IrisLight& light,
                         int delay_ticks) {
  if (!present_) return {};
  if (!view.healthy) {
    fault_ = true;
    return {};
  }
  if (view.automatic) return take_over(view);
  if (contradictions_ == 0) fault_ = false;
  phase_ticks_ = std::min(phase_ticks_ + 1, kExerciseEvery_ticks);
  idle_ticks_ = std::min(idle_ticks_ + 1, kExerciseEvery_ticks);
  switch (phase_) {
    case Phase::resting:
      return view.moving ? IrisOrder{} : begin(view, wish, light);
    case Phase::moving:
      return move_on(view);
    case Phase::settling:
      return settle(view, light, delay_ticks);
  }
  return {};
}

}  // namespace dottrack::exposure
