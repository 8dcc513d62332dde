#pragma once
// A P-iris as its motor sees it: a shaft that turns blades with some play between hard ends, and a
// switch near the closed one. It counts what the lines do and what they must not do.

#include <algorithm>
#include <cstdint>
#include <optional>

#include "drivers/libgpiod/iris_motor.h"

namespace dottrack::test {

struct Mechanics {
  int travel = 40;
  int play = 0;            // steps of the shaft that do not move the blades
  int start = 17;          // of the blades
  int spare = 3;           // how far the hard ends are beyond the travel
  int switch_release = 2;  // the switch closes at 0 and opens above this
  Duration period = std::chrono::milliseconds(10);  // it loses steps that are closer
};

class MechanicalIris {
 public:
  explicit MechanicalIris(const Mechanics& mechanics)
      : made_(mechanics), shaft_(mechanics.start), blades_(mechanics.start) {
    turn_switch();
  }

  void drive(const drivers::MotorPins& pins, Time now) {
    if (pins.opening != pins_.opening || pins.enable != pins_.enable) set_up_ = now;
    if (pins.opening != pins_.opening && pins_.step) ++violations_;
    if (pins.step && !pins_.step) rise(pins, now);
    if (!pins.step && pins_.step) fall(now);
    pins_ = pins;
  }

  bool end_stop() const { return broken_switch_ ? *broken_switch_ : switch_; }
  void break_switch(bool always) { broken_switch_ = always; }
  // The lens's own auto-iris moves the blades; the shaft goes with them.
  void drift_to(int position) {
    shaft_ += position - blades_;
    blades_ = position;
    turn_switch();
  }

  int blades() const { return blades_; }
  std::uint64_t edges() const { return edges_; }
  int stalls() const { return stalls_; }          // steps against a hard end
  int violations() const { return violations_; }  // of the motor's time limits, or unpowered steps
  const drivers::MotorPins& pins() const { return pins_; }

 private:
  void rise(const drivers::MotorPins& pins, Time now) {
    const bool first = edges_ == 0;
    if (!pins.enable) ++violations_;
    if (!first && now - rose_ < made_.period) ++violations_;
    if (!first && now - fell_ < made_.period / 2) ++violations_;
    if (now - set_up_ < made_.period / 2) ++violations_;
    rose_ = now;
    ++edges_;
    turn(pins.opening ? 1 : -1);
  }

  void fall(Time now) {
    if (now - rose_ < made_.period / 2) ++violations_;
    fell_ = now;
  }

  void turn(int by) {
    const int shaft = shaft_ + by;
    const int blades = std::clamp(blades_, shaft - made_.play, shaft);
    if (blades < -made_.spare || blades > made_.travel + made_.spare) {
      ++stalls_;
      return;
    }
    shaft_ = shaft;
    blades_ = blades;
    turn_switch();
  }

  void turn_switch() {
    if (blades_ <= 0) switch_ = true;
    if (blades_ > made_.switch_release) switch_ = false;
  }

  Mechanics made_;
  drivers::MotorPins pins_;
  int shaft_;   // blades_ to blades_ + play
  int blades_;  // 0 closed to travel open
  bool switch_ = false;
  std::optional<bool> broken_switch_;
  std::uint64_t edges_ = 0;
  int stalls_ = 0;
  int violations_ = 0;
  Time set_up_{};
  Time rose_{};
  Time fell_{};
};

}  // namespace dottrack::test
