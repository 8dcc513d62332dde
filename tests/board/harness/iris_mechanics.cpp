#include "tests/board/harness/iris_mechanics.h"

#include <algorithm>

namespace dottrack::board {

void IrisMechanics::set(Line line, bool high) {
  switch (line) {
    case Line::step:
      if (high && !step_) step();
      step_ = high;
      break;
    case Line::direction:
      opens_ = high;
      break;
    case Line::enable:
      enable_ = high;
      break;
    case Line::override_auto:
      override_auto_ = high;
      break;
  }
}

void IrisMechanics::step() {
  ++steps_;
  if (!enable_) {
    ++idle_steps_;
    return;
  }
  const int end = opens_ ? shape_.backlash_steps : 0;
  if (play_ != end) {
    play_ += opens_ ? 1 : -1;
    return;
  }
  blades_ = std::clamp(blades_ + (opens_ ? 1 : -1), 0, shape_.travel_steps);
  was_closed_ = was_closed_ || blades_ == 0;
}

}  // namespace dottrack::board
