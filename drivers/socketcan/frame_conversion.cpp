#include "drivers/socketcan/frame_conversion.h"

#include <algorithm>
#include <iterator>

namespace dottrack::drivers {
namespace {

static_assert(sizeof(can_frame) == CAN_MTU && sizeof(canfd_frame) == CANFD_MTU);
static_assert(offsetof(can_frame, can_id) == offsetof(canfd_frame, can_id) &&
                  offsetof(can_frame, len) == offsetof(canfd_frame, len) &&
                  offsetof(can_frame, data) == offsetof(canfd_frame, data),
              "a classic frame is the beginning of an FD frame");

constexpr bool is_length(std::size_t length, bool fd) {
  if (length <= CAN_MAX_DLEN) return true;
  constexpr std::size_t kLong[] = {12, 16, 20, 24, 32, 48, 64};
  return fd && std::ranges::find(kLong, length) != std::end(kLong);
}

constexpr std::uint32_t largest_id(bool extended) {
  return extended ? CAN_EFF_MASK : CAN_SFF_MASK;
}

}  // namespace

std::optional<WireFrame> to_wire(const hal::CanFrame& frame) {
  if (frame.id > largest_id(frame.extended)) return std::nullopt;
  if (!is_length(frame.length, frame.fd)) return std::nullopt;
  if (frame.bit_rate_switch && !frame.fd) return std::nullopt;
  WireFrame wire;
  wire.size = frame.fd ? CANFD_MTU : CAN_MTU;
  wire.frame.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U);
  wire.frame.len = frame.length;
  wire.frame.flags = frame.bit_rate_switch ? CANFD_BRS : 0;
  std::ranges::copy(frame.payload(), wire.frame.data);
  return wire;
}

std::optional<hal::CanFrame> from_wire(const WireFrame& wire) {
  if (wire.size != CAN_MTU && wire.size != CANFD_MTU) return std::nullopt;
  const canfd_frame& raw = wire.frame;
  if ((raw.can_id & (CAN_ERR_FLAG | CAN_RTR_FLAG)) != 0) return std::nullopt;
  hal::CanFrame frame;
  frame.fd = wire.size == CANFD_MTU;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.id = raw.can_id & CAN_EFF_MASK;
  if (frame.id > largest_id(frame.extended) || !is_length(raw.len, frame.fd)) return std::nullopt;
  frame.bit_rate_switch = frame.fd && (raw.flags & CANFD_BRS) != 0;
  frame.length = raw.len;
  std::copy_n(raw.data, raw.len, frame.data.begin());
  return frame;
}

}  // namespace dottrack::drivers
