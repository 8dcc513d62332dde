#pragma once
// MAVLink 2 framing, of what we send: unsigned frames, no incompatibility flags.
//
// A frame: 0xFD, payload length, incompatibility flags, compatibility flags, sequence, system,
// component, message id (3 bytes), payload, checksum (2 bytes); everything little-endian. The
// checksum runs over all but the first byte and itself, and then over the message's CRC_EXTRA,
// which stands for the layout of its fields. Zeros at a payload's end are not sent, but for its
// first byte. Source: mavlink.io, "Packet Serialization".

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dottrack::workstation {

inline constexpr std::size_t kMaxMavlinkPayload = 255;
inline constexpr std::size_t kMaxMavlinkFrame = 10 + kMaxMavlinkPayload + 2;

struct MavlinkMessage {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::size_t length = 0;  // of the payload, whole
  std::array<std::uint8_t, kMaxMavlinkPayload> payload{};
};

struct MavlinkSource {
  std::uint8_t sequence = 0;  // one more a frame
  std::uint8_t system = 0;
  std::uint8_t component = 0;
};

struct MavlinkFrame {
  std::size_t length = 0;
  std::array<std::uint8_t, kMaxMavlinkFrame> bytes{};

  std::span<const std::uint8_t> view() const { return std::span(bytes).first(length); }
};

// CRC-16/MCRF4XX, which MAVLink calls X.25: "123456789" gives 0x6F91.
std::uint16_t x25_checksum(std::span<const std::uint8_t> bytes, std::uint16_t start = 0xFFFF);

MavlinkFrame framed(const MavlinkMessage& message, const MavlinkSource& source);

}  // namespace dottrack::workstation
