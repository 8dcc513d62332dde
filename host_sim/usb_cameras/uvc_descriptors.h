#pragma once
// What an emulated camera tells of itself: USB 2.0 and USB Video Class 1.0 descriptors of a high-
// speed camera with one 8-bit grey format of one size and one rate, streamed over a bulk endpoint.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dottrack::host_sim {

struct UvcFacts {
  std::string product;
  std::string serial;
  int width_px = 640;
  int height_px = 480;
  double frame_rate_hz = 3.0;
};

inline constexpr std::uint16_t kUvcVendor = 0x1d6b;  // as the kernel's own UVC gadget
inline constexpr std::uint16_t kUvcProduct = 0x0102;
inline constexpr std::uint16_t kUvcRelease = 0x0100;

inline constexpr std::uint8_t kMiscellaneousClass = 0xef;  // with subclass 2 and protocol 1:
inline constexpr std::uint8_t kVideoClass = 0x0e;          // interfaces come in associations
inline constexpr std::uint8_t kVideoControlSubclass = 1;
inline constexpr std::uint8_t kVideoStreamingSubclass = 2;

inline constexpr std::uint8_t kControlInterface = 0;
inline constexpr std::uint8_t kStreamInterface = 1;
inline constexpr std::uint8_t kStreamEndpoint = 0x81;
inline constexpr std::uint16_t kStreamPacket_bytes = 512;
inline constexpr std::uint8_t kControlPacket_bytes = 64;

inline constexpr std::uint8_t kCameraTerminal = 1;
inline constexpr std::uint8_t kProcessingUnit = 2;

inline constexpr std::size_t kPayloadHeader_bytes = 2;

using Bytes = std::vector<std::uint8_t>;

std::uint32_t frame_bytes(const UvcFacts& facts);
std::uint32_t frame_interval_100ns(const UvcFacts& facts);

Bytes device_descriptor();
Bytes device_qualifier();
Bytes configuration_descriptor(const UvcFacts& facts);
// Empty for an index of which there is no string. 0 tells the language.
Bytes string_descriptor(const UvcFacts& facts, std::uint8_t index);

// The one answer to probe and commit: 26 bytes.
Bytes stream_parameters(const UvcFacts& facts);

}  // namespace dottrack::host_sim
