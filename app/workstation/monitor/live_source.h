#pragma once
// The frames of a bus, as they come.

#include <string>

#include "app/workstation/monitor/frame_source.h"
#include "hal/can_bus.h"
#include "rtos_shim/clock.h"

namespace dottrack::monitor {

// Survives the device: it tells when it goes and goes on asking for frames.
class LiveSource final : public FrameSource {
 public:
  // `start`: the time since 1970 now. From there on only the clock counts, which never goes back.
  // Bus and clock outlive the source.
  LiveSource(hal::CanBus& bus, const rtos::Clock& clock, std::string interface, Duration start);

 private:
  Got do_next(Arrival& arrival) override;
  std::string do_notice() override;
  Duration now() const;

  hal::CanBus& bus_;
  const rtos::Clock& clock_;
  std::string interface_;
  Duration offset_;
  hal::CanState told_ = hal::CanState::active;
};

}  // namespace dottrack::monitor
