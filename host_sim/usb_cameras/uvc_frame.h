#pragma once
// A picture on its way to the host: cut into payloads, each with a header, and these into the
// pieces that the host's transfers have room for.

#include <cstdint>
#include <memory>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/usb_cameras/uvc_descriptors.h"

namespace dottrack::host_sim {

// The first payload is short, so that all cameras' first bytes reach the host at almost the same
// time: that is where a host takes the time of a frame. A payload ends with a transfer that is not
// full. Header: FID toggles from frame to frame, EOF marks a frame's last payload.
class UvcFrame {
 public:
  static constexpr std::size_t kFirstPayload_bytes = 256;  // header included

  // Whatever of the frame before was not sent never will be.
  void begin(std::shared_ptr<const GreyImage> image);
  void abandon() { image_.reset(); }
  bool in_transit() const { return image_ != nullptr; }

  // The next transfer's bytes, at most `room`; empty only to end a payload that filled its
  // transfers. Only while in_transit(); room is more than a header.
  const Bytes& next_piece(std::size_t room);

 private:
  std::shared_ptr<const GreyImage> image_;
  std::size_t sent_ = 0;         // pixels
  std::size_t payload_end_ = 0;  // pixels
  bool header_due_ = false;
  bool frame_id_ = false;
  Bytes piece_;
};

}  // namespace dottrack::host_sim
