#include "app/workstation/monitor/live_source.h"

#include <thread>
#include <utility>

namespace dottrack::monitor {
namespace {

// Short beside the shortest time between two frames that matters for jitter; long beside a look.
constexpr Duration kPause = std::chrono::microseconds(300);

const char* words(hal::CanState state) {
  switch (state) {
    case hal::CanState::active:
    case hal::CanState::warning:
    case hal::CanState::passive:
      return "back on the bus";
    case hal::CanState::bus_off:
      return "off the bus; waiting for it to come back";
    case hal::CanState::absent:
      return "down or gone; waiting for it to come back";
  }
  return "in an unknown state";
}

bool listens(hal::CanState state) {
  return state != hal::CanState::bus_off && state != hal::CanState::absent;
}

}  // namespace

LiveSource::LiveSource(hal::CanBus& bus, const rtos::Clock& clock, std::string interface,
                       Duration start)
    : bus_(bus),
      clock_(clock),
      interface_(std::move(interface)),
      offset_(start - clock.now().time_since_epoch()) {}

Duration LiveSource::now() const {
  return clock_.now().time_since_epoch() + offset_;
}

FrameSource::Got LiveSource::do_next(Arrival& arrival) {
  if (bus_.receive(arrival.frame)) {
    arrival.time = now();
    return Got::frame;
  }
  std::this_thread::sleep_for(kPause);
  arrival.time = now();
  return Got::nothing;
}

std::string LiveSource::do_notice() {
  const hal::CanState state = bus_.state();
  const bool changed = listens(state) != listens(told_) || (!listens(state) && state != told_);
  if (!changed) return {};
  told_ = state;
  return interface_ + " is " + words(state);
}

}  // namespace dottrack::monitor
