#pragma once
// A watchdog in virtual time. It restarts nothing; it remembers that it would have.

#include <optional>

#include "rtos_shim/virtual_time/virtual_clock.h"
#include "rtos_shim/watchdog.h"

namespace dottrack::rtos {

class VirtualWatchdog final : public Watchdog {
 public:
  // timeout > 0. The clock outlives the watchdog, which is armed at once.
  VirtualWatchdog(const VirtualClock& clock, Duration timeout);

  bool bitten() const { return bitten_at().has_value(); }
  // When it bit for the first time, which no later kick undoes; none: it has not.
  std::optional<Time> bitten_at() const;

 private:
  void do_kick() override;
  Duration do_timeout() const override { return timeout_; }

  const VirtualClock& clock_;
  Duration timeout_;
  Time last_kick_;
};

}  // namespace dottrack::rtos
