#pragma once
// The stepper of one P-iris as a state machine: what its lines should be at an instant. It knows no
// GPIO and no clock but the time it is given.

#include <cstdint>
#include <optional>

#include "hal/base/time.h"

namespace dottrack::drivers {

struct MotorSettings {
  int travel_steps = 1;                                  // from closed (position 0) to fully open
  Duration step_period = std::chrono::milliseconds(10);  // never two steps closer than this
  int backlash_steps = 0;
  bool has_end_stop = false;   // else the motor is driven against the closed end
  bool has_auto_iris = false;  // moves the blades while the motor is released
};

// What is asked of a motor now, however often it changed since it was last looked at.
struct MotorRequest {
  std::optional<int> target_steps;  // nothing: the lens's own auto-iris is in charge
  std::uint16_t releases = 0;       // times the lens was given back so far

  bool operator==(const MotorRequest&) const = default;
};

// Active or not, line by line.
struct MotorPins {
  bool step = false;
  bool opening = false;  // direction
  bool enable = false;
  bool override_auto = false;

  bool operator==(const MotorPins&) const = default;
};

enum class MotorPhase : std::uint8_t { released, homing, moving, at_rest, faulty };

// The first movement, and the first after the auto-iris was in charge, begins with homing: towards
// the closed end until the end stop is active or, without one, for the whole travel and more. From
// there positions are counted. On reversal the steps that only take up the backlash are not
// counted. A motor whose end stop contradicts its position is faulty until it is released.
class IrisMotor {
 public:
  IrisMotor(const MotorSettings& settings, Time start);

  // The lines from `now` on. Due every half step period; called later or more often, the motor is
  // slower, never faster.
  MotorPins advance(Time now, const MotorRequest& request, bool end_stop);
  // Its lines could not be driven or read: where it is is no longer known.
  void lose();

  MotorPhase phase() const { return phase_; }
  // Nothing is under way: until another request, lines and end stop may be left alone.
  bool idle() const;
  int position_steps() const { return position_; }  // a guess before homing
  std::uint64_t steps() const { return steps_; }    // made so far, homing included

 private:
  enum class Heading : std::uint8_t { none, closing, opening };

  void obey(const MotorRequest& request);
  void begin_homing();
  Heading heading(bool end_stop);
  Heading homing_heading(bool end_stop);
  std::optional<bool> settled_stop(bool end_stop);
  Heading moving_heading();
  Heading arrive_home();
  void end_pulse(Time now);
  void rest(Time now);
  void head(Time now, Heading where, bool end_stop);
  void begin_pulse(Time now, Heading where, bool end_stop);
  void count(Heading where);
  void watch_stop(bool end_stop);
  int overrun() const;

  MotorSettings settings_;
  Duration half_period_;
  MotorPhase phase_ = MotorPhase::released;
  MotorPins pins_;
  MotorRequest request_;
  bool homed_ = false;
  bool leaving_stop_ = false;  // homing began with the end stop active
  int homing_steps_left_ = 0;
  bool stop_reading_ = false;
  int stop_readings_ = 0;  // in a row that were the same
  int stray_stop_ = 0;     // steps in a row with the stop active where it should not be
  int position_ = 0;       // of the blades
  int taken_up_ = 0;       // of the backlash; 0: a closing step moves the blades, all: an opening
  std::uint64_t steps_ = 0;
  Time pulse_end_;
  Time next_step_;
  Time rest_until_;
};

}  // namespace dottrack::drivers
