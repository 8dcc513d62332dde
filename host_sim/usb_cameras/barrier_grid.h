#pragma once
// The instants at which all cameras expose: first + n periods, whatever is missed on the way.

#include <cmath>
#include <cstdint>

#include "hal/base/time.h"

namespace dottrack::host_sim {

class BarrierGrid {
 public:
  explicit BarrierGrid(double rate_hz) : period_(std::llround(1e9 / rate_hz)) {}

  // The first instant is one period from now.
  void start(Time now) { next_ = now + period_; }
  Time next() const { return next_; }
  Duration period() const { return period_; }

  // How many instants have come since it was last asked.
  std::uint64_t passed(Time now) {
    if (now < next_) return 0;
    const Duration::rep instants = (now - next_) / period_ + 1;
    next_ += instants * period_;
    return static_cast<std::uint64_t>(instants);
  }

 private:
  Duration period_;
  Time next_{};
};

}  // namespace dottrack::host_sim
