#include "host_sim/usb_cameras/uvc_frame.h"

#include <algorithm>
#include <utility>

namespace dottrack::host_sim {
namespace {

constexpr std::uint8_t kFrameId = 0x01;
constexpr std::uint8_t kEndOfFrame = 0x02;
constexpr std::uint8_t kEndOfHeader = 0x80;

}  // namespace

void UvcFrame::begin(std::shared_ptr<const GreyImage> image) {
  image_ = std::move(image);
  frame_id_ = !frame_id_;
  sent_ = 0;
  payload_end_ = std::min(image_->pixels().size(), kFirstPayload_bytes - kPayloadHeader_bytes);
  header_due_ = true;
}

const Bytes& UvcFrame::next_piece(std::size_t room) {
  const std::vector<std::uint8_t>& pixels = image_->pixels();
  piece_.clear();
  if (header_due_) {
    const bool last = payload_end_ == pixels.size();
    piece_ = {kPayloadHeader_bytes,
              static_cast<std::uint8_t>(kEndOfHeader | (last ? kEndOfFrame : 0) |
                                        (frame_id_ ? kFrameId : 0))};
    header_due_ = false;
  }
  const std::size_t count = std::min(room - piece_.size(), payload_end_ - sent_);
  const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(sent_);
  piece_.insert(piece_.end(), from, from + static_cast<std::ptrdiff_t>(count));
  sent_ += count;
  if (piece_.size() == room) return piece_;  // the payload is not over, be it by an empty piece
  if (sent_ == pixels.size()) {
    image_.reset();
  } else {
    payload_end_ = pixels.size();
    header_due_ = true;
  }
  return piece_;
}

}  // namespace dottrack::host_sim
