#include "drivers/socketcan/controller_state.h"

namespace dottrack::drivers {
namespace {

constexpr Duration kFlagsLag = std::chrono::milliseconds(1500);

}  // namespace

ControllerState::Change ControllerState::on_report(const ErrorReport& report, Time now) {
  // What waited in the socket when the link went away is of yesterday.
  if (state_ == hal::CanState::absent) return {};
  if (report.bus_off) {
    told_ = now;
    return become(hal::CanState::bus_off);
  }
  if (report.restarted) told_ = now;
  if (report.fault) return become(*report.fault);
  if (report.restarted) return become(hal::CanState::active);
  if (report.counts && can_send()) return become(*report.counts);
  return {};
}

ControllerState::Change ControllerState::on_link(LinkState link, Time now) {
  switch (link) {
    case LinkState::gone:
    case LinkState::down:
      told_.reset();
      return become(hal::CanState::absent);
    case LinkState::no_carrier:
      return flags_may_lag(now) ? Change{} : become(hal::CanState::bus_off);
    case LinkState::running:
      break;
  }
  const bool back =
      state_ == hal::CanState::absent || (state_ == hal::CanState::bus_off && !flags_may_lag(now));
  return back ? become(hal::CanState::active) : Change{};
}

ControllerState::Change ControllerState::become(hal::CanState state) {
  const bool could_send = can_send();
  const bool was_off = state_ == hal::CanState::bus_off;
  state_ = state;
  Change change;
  // Down and up again, a link still shows its old carrier for a moment: no new bus-off.
  change.bus_off = state == hal::CanState::bus_off && !was_off && (could_send || !could_ever_send_);
  change.recovered = can_send() && !could_send && could_ever_send_;
  could_ever_send_ = could_ever_send_ || can_send();
  return change;
}

bool ControllerState::flags_may_lag(Time now) const {
  return told_ && now - *told_ < kFlagsLag;
}

}  // namespace dottrack::drivers
