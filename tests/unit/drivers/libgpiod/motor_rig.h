#pragma once
// An iris motor on a mechanical iris, and the time that both live in.

#include "tests/unit/drivers/libgpiod/mechanical_iris.h"

namespace dottrack::test {

class MotorRig {
 public:
  static constexpr Duration kHalfStep = std::chrono::milliseconds(5);

  MotorRig(const drivers::MotorSettings& settings, const Mechanics& mechanics)
      : iris(mechanics), motor(settings, now) {}

  void ask(std::optional<int> target) {
    request.target_steps = target;
    if (!target) ++request.releases;
  }

  void tick(Duration later = kHalfStep) {
    now += later;
    iris.drive(motor.advance(now, request, iris.end_stop()), now);
  }

  // Until `done` or, if that never is, a good while.
  template <class Done>
  bool run_until(Done done) {
    for (int i = 0; i < 2000; ++i) {
      if (done()) return true;
      tick();
    }
    return false;
  }

  bool settle() {
    tick();  // takes the request
    return run_until([this] { return motor.idle(); });
  }

  bool go(int target) {
    ask(target);
    return settle();
  }

  Time now{};
  drivers::MotorRequest request;
  MechanicalIris iris;
  drivers::IrisMotor motor;
};

}  // namespace dottrack::test
