#include "app/workstation/mavlink/mavlink_frame.h"

#include <algorithm>

namespace dottrack::workstation {
namespace {

constexpr std::uint8_t kStart = 0xFD;
constexpr std::size_t kHeader = 10;

std::uint8_t byte_of(std::uint32_t value, unsigned index) {
  return static_cast<std::uint8_t>(value >> (8 * index));
}

std::size_t truncated(const MavlinkMessage& message) {
  std::size_t length = message.length;
  while (length > 1 && message.payload[length - 1] == 0) --length;
  return length;
}

}  // namespace

std::uint16_t x25_checksum(std::span<const std::uint8_t> bytes, std::uint16_t start) {
  constexpr std::uint32_t kReversedPolynomial = 0x8408;  // of x^16 + x^12 + x^5 + 1
  std::uint32_t crc = start;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1U) != 0 ? (crc >> 1U) ^ kReversedPolynomial : crc >> 1U;
    }
  }
  return static_cast<std::uint16_t>(crc);
}

MavlinkFrame framed(const MavlinkMessage& message, const MavlinkSource& source) {
  const std::size_t length = truncated(message);
  MavlinkFrame frame;
  const std::array<std::uint8_t, kHeader> header{kStart,
                                                 static_cast<std::uint8_t>(length),
                                                 0,
                                                 0,
                                                 source.sequence,
                                                 source.system,
                                                 source.component,
                                                 byte_of(message.id, 0),
                                                 byte_of(message.id, 1),
                                                 byte_of(message.id, 2)};
  std::ranges::copy(header, frame.bytes.begin());
  std::copy_n(message.payload.begin(), length, frame.bytes.begin() + kHeader);
  const std::size_t end = kHeader + length;
  const std::uint16_t of_frame = x25_checksum(std::span(frame.bytes).subspan(1, end - 1));
  const std::uint16_t checksum = x25_checksum(std::span(&message.crc_extra, 1), of_frame);
  frame.bytes[end] = byte_of(checksum, 0);
  frame.bytes[end + 1] = byte_of(checksum, 1);
  frame.length = end + 2;
  return frame;
}

}  // namespace dottrack::workstation
