#pragma once
// The state of a CAN controller, put together from its error frames and its link's flags.

#include <optional>

#include "drivers/socketcan/can_link.h"
#include "drivers/socketcan/error_frame.h"
#include "hal/base/time.h"
#include "hal/can_bus.h"

namespace dottrack::drivers {

// Error frames tell bus-off and restart at once; the flags follow up to a second later, because the
// kernel collects changes of carrier. They also tell what no error frame does (down, up, gone), and
// end a bus-off whose restart was not heard.
class ControllerState {
 public:
  // What changed for the worse or the better with one piece of news.
  struct Change {
    bool bus_off = false;    // went off the bus
    bool recovered = false;  // can send again after bus-off, down or gone
  };

  Change on_report(const ErrorReport& report, Time now);
  Change on_link(LinkState link, Time now);

  hal::CanState state() const { return state_; }
  bool can_send() const {
    return state_ != hal::CanState::absent && state_ != hal::CanState::bus_off;
  }

 private:
  Change become(hal::CanState state);
  bool flags_may_lag(Time now) const;

  hal::CanState state_ = hal::CanState::absent;
  bool could_ever_send_ = false;  // before the first time nothing can be recovered
  std::optional<Time> told_;      // when an error frame last told of bus-off or restart
};

}  // namespace dottrack::drivers
