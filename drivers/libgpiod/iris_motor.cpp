#include "drivers/libgpiod/iris_motor.h"

#include <algorithm>

namespace dottrack::drivers {
namespace {

constexpr Duration kHold = std::chrono::milliseconds(100);  // current stays on after a movement
constexpr int kStopReadings = 2;                            // one alone may be a disturbance
constexpr int kStrayStops = 3;

}  // namespace

IrisMotor::IrisMotor(const MotorSettings& settings, Time start)
    : settings_(settings),
      half_period_((settings.step_period + Duration(1)) / 2),
      position_(settings.travel_steps),
      pulse_end_(start),
      next_step_(start),
      rest_until_(start) {}

MotorPins IrisMotor::advance(Time now, const MotorRequest& request, bool end_stop) {
  obey(request);
  if (pins_.step) {
    end_pulse(now);
    return pins_;
  }
  const Heading where = heading(end_stop);
  if (where == Heading::none) {
    rest(now);
  } else {
    head(now, where, end_stop);
  }
  return pins_;
}

void IrisMotor::lose() {
  homed_ = false;
  if (phase_ != MotorPhase::released) phase_ = MotorPhase::faulty;
}

bool IrisMotor::idle() const {
  const bool still = phase_ != MotorPhase::homing && phase_ != MotorPhase::moving;
  return still && !pins_.step && !pins_.enable;
}

void IrisMotor::obey(const MotorRequest& request) {
  if (request == request_) return;
  const bool released = request.releases != request_.releases || !request.target_steps;
  request_ = request;
  if (released) {
    phase_ = MotorPhase::released;
    homed_ = homed_ && !settings_.has_auto_iris;
  }
  pins_.override_auto = request.target_steps.has_value();
  if (!request.target_steps || phase_ == MotorPhase::faulty) return;
  if (homed_) {
    phase_ = MotorPhase::moving;
  } else if (phase_ != MotorPhase::homing) {
    begin_homing();
  }
}

void IrisMotor::begin_homing() {
  phase_ = MotorPhase::homing;
  leaving_stop_ = settings_.has_end_stop;
  homing_steps_left_ = settings_.travel_steps + overrun();
  stop_readings_ = 0;
  stray_stop_ = 0;
}

int IrisMotor::overrun() const {
  return 2 + settings_.travel_steps / 10 + settings_.backlash_steps;
}

IrisMotor::Heading IrisMotor::heading(bool end_stop) {
  if (phase_ == MotorPhase::homing) return homing_heading(end_stop);
  if (phase_ == MotorPhase::moving) return moving_heading();
  return Heading::none;
}

// The end stop counts where it becomes active on the way to it, so a motor that starts on it first
// leaves it.
IrisMotor::Heading IrisMotor::homing_heading(bool end_stop) {
  if (!settings_.has_end_stop) return homing_steps_left_ > 0 ? Heading::closing : arrive_home();
  const std::optional<bool> on_stop = settled_stop(end_stop);
  if (!on_stop) return Heading::none;
  if (leaving_stop_ && !*on_stop) {
    leaving_stop_ = false;
    homing_steps_left_ = settings_.travel_steps + overrun();
  }
  if (!leaving_stop_ && *on_stop) return arrive_home();
  if (homing_steps_left_ > 0) return leaving_stop_ ? Heading::opening : Heading::closing;
  lose();
  return Heading::none;
}

// Nothing until readings in a row agree: one alone may be a disturbance.
std::optional<bool> IrisMotor::settled_stop(bool end_stop) {
  stop_readings_ = end_stop == stop_reading_ ? stop_readings_ + 1 : 1;
  stop_reading_ = end_stop;
  return stop_readings_ >= kStopReadings ? std::optional(end_stop) : std::nullopt;
}

IrisMotor::Heading IrisMotor::arrive_home() {
  homed_ = true;
  position_ = 0;
  taken_up_ = 0;
  phase_ = MotorPhase::moving;
  return moving_heading();
}

IrisMotor::Heading IrisMotor::moving_heading() {
  const int target = request_.target_steps.value_or(position_);
  if (target == position_) {
    phase_ = MotorPhase::at_rest;
    return Heading::none;
  }
  return target > position_ ? Heading::opening : Heading::closing;
}

// Half a period up and half a period down: never two steps closer than a period.
void IrisMotor::end_pulse(Time now) {
  if (now < pulse_end_) return;
  pins_.step = false;
  next_step_ = std::max(next_step_, now + half_period_);
}

void IrisMotor::rest(Time now) {
  const bool may_let_go = phase_ == MotorPhase::released || now >= rest_until_;
  if (may_let_go && phase_ != MotorPhase::homing) pins_.enable = false;
}

// A motor that is switched on or turned round gets half a step period before its next step.
void IrisMotor::head(Time now, Heading where, bool end_stop) {
  const bool opening = where == Heading::opening;
  if (!pins_.enable || pins_.opening != opening) {
    pins_.enable = true;
    pins_.opening = opening;
    next_step_ = std::max(next_step_, now + half_period_);
    return;
  }
  if (now >= next_step_) begin_pulse(now, where, end_stop);
}

void IrisMotor::begin_pulse(Time now, Heading where, bool end_stop) {
  if (phase_ == MotorPhase::moving && settings_.has_end_stop) watch_stop(end_stop);
  if (phase_ == MotorPhase::faulty) return;
  pins_.step = true;
  pulse_end_ = now + half_period_;
  rest_until_ = now + settings_.step_period + kHold;
  ++steps_;
  count(where);
}

void IrisMotor::count(Heading where) {
  if (phase_ == MotorPhase::homing) {
    --homing_steps_left_;
    if (!leaving_stop_) position_ = std::max(position_ - 1, 0);
  } else if (where == Heading::opening) {
    ++(taken_up_ < settings_.backlash_steps ? taken_up_ : position_);
  } else {
    --(taken_up_ > 0 ? taken_up_ : position_);
  }
}

void IrisMotor::watch_stop(bool end_stop) {
  const bool stray = end_stop && position_ > overrun();
  stray_stop_ = stray ? stray_stop_ + 1 : 0;
  if (stray_stop_ >= kStrayStops) lose();
}

}  // namespace dottrack::drivers
