#pragma once
// Where the monitor's frames come from: a bus or a log.

#include <cstdint>
#include <string>

#include "hal/base/can_frame.h"
#include "hal/base/time.h"

namespace dottrack::monitor {

struct Arrival {
  Duration time{};  // since 1970, as far as the source knows; never goes back
  hal::CanFrame frame;
};

class FrameSource {
 public:
  enum class Got : std::uint8_t {
    frame,
    nothing,  // for the moment: `arrival.time` is now, the frame means nothing
    end,
  };

  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  // Waits a few milliseconds at most, unless it reads from a pipe.
  Got next(Arrival& arrival) { return do_next(arrival); }
  // What befell the source since the last call, one line; empty: nothing.
  std::string notice() { return do_notice(); }

 private:
  virtual Got do_next(Arrival& arrival) = 0;
  virtual std::string do_notice() { return {}; }
};

}  // namespace dottrack::monitor
