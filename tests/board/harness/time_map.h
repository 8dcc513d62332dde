#pragma once
// Which instant of this machine's clock an instant of the guest's clock is.

#include <optional>

#include "hal/base/time.h"

namespace dottrack::board {

// Both clocks run at one rate, so one offset is all there is. Every question to the guest bounds
// it: the answer was true at some instant between the question and its arrival.
class TimeMap {
 public:
  void add(Time asked, Time guest, Time answered);

  bool known() const { return known_ && latest_ >= earliest_; }
  // Half the width of what the bounds leave open.
  Duration uncertainty() const { return (latest_ - earliest_) / 2; }
  Time to_host(Time guest) const { return guest + earliest_ + (latest_ - earliest_) / 2; }

 private:
  bool known_ = false;
  Duration earliest_{};  // bounds of host minus guest
  Duration latest_{};
};

}  // namespace dottrack::board
