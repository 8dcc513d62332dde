#pragma once
// What restarts the unit when its loop has stopped turning.

#include "hal/base/time.h"

namespace dottrack::rtos {

// Contract: armed from construction. When two calls of kick() are more than timeout() apart, the
// unit is restarted. kick() neither blocks nor allocates.
class Watchdog {
 public:
  Watchdog() = default;
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  virtual ~Watchdog() = default;

  void kick() { do_kick(); }
  Duration timeout() const { return do_timeout(); }

 private:
  virtual void do_kick() = 0;
  virtual Duration do_timeout() const = 0;
};

}  // namespace dottrack::rtos
