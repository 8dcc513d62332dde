#pragma once
// The descriptor work: frames in and out of a socket that speaks can_frame and canfd_frame. A CAN
// raw socket does; so does one end of an AF_UNIX SOCK_SEQPACKET pair.

#include <cstdint>

#include "drivers/socketcan/frame_conversion.h"
#include "hal/base/time.h"

namespace dottrack::drivers {

class CanPort {
 public:
  enum class Written : std::uint8_t { done, full, down, gone, refused };
  enum class Read : std::uint8_t { frame, nothing, down, gone };

  explicit CanPort(int descriptor) : descriptor_(descriptor) {}  // closes it at the end
  CanPort(CanPort&& other) noexcept;
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;
  ~CanPort();

  int descriptor() const { return descriptor_; }

  // Neither waits, whatever the descriptor is set to.
  Written write(const WireFrame& wire) const;
  Read read(WireFrame& wire) const;

 private:
  int descriptor_;
};

// Sleeps. Waiting for the descriptor instead would not do: a socket whose interface has a full
// queue (ENOBUFS) counts as writable.
void pause_for(Duration duration);

}  // namespace dottrack::drivers
