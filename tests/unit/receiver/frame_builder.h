#pragma once
// Frames as a unit sends them, put together bit by bit from the layout's numbers: knows neither the
// unit's encoder nor the receiver's tables.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

#include "app/core/protocol/receiver/dottrack_receiver.h"

namespace dottrack::receiver_test {

using Frames = std::vector<dottrack_frame>;

constexpr unsigned kStatus = 0;
constexpr unsigned kTime = 1;
constexpr unsigned kQuality = 2;
constexpr unsigned kPosition = 3;
constexpr unsigned kPosition2 = 4;
constexpr unsigned kOrientation = 5;
constexpr unsigned kCameras = 13;
constexpr unsigned kVersion = 14;
constexpr unsigned kConfiguration = 15;
constexpr unsigned kFdPose = 16;
constexpr unsigned kReply = 17;
constexpr unsigned kCommand = 18;
constexpr unsigned kLight = 19;
constexpr unsigned kFirstDot = 32;
constexpr std::uint64_t kClockMask = (std::uint64_t{1} << 48U) - 1;

struct DotBits {
  std::array<std::int32_t, 3> position{};
  std::uint16_t cameras = 0;
  std::uint8_t visibility = 0;
  std::uint8_t sigma = 0;
};

// The raw numbers of a group's signals.
struct Group {
  bool fd = false;
  std::uint8_t sequence = 0;
  std::uint8_t version = DOTTRACK_PROTOCOL_VERSION;
  std::uint8_t state = DOTTRACK_TRACKING;
  bool valid = true;
  bool out_of_range = false;
  std::uint8_t reason = 0;
  std::uint16_t cameras_used = 0x0003;
  std::uint8_t dots_used = 5;
  std::uint8_t kind = 0;
  std::uint8_t reset_count = 1;
  std::uint64_t capture_us = 0;
  std::uint16_t age = 200;  // 20 ms
  std::uint16_t degraded = 0;
  std::uint8_t false_lock = 40;
  std::uint8_t dots_follow = 0;
  bool covariance = false;
  bool motion = false;
  bool cameras = false;
  std::array<std::int32_t, 3> position{10000, -20000, 3000};
  std::array<std::int32_t, 4> orientation{32258, 0, 0, 0};  // w x y z
  std::uint8_t residual = 4;
  std::array<std::int32_t, 3> velocity{};
  std::array<std::int32_t, 3> rates{};
  std::array<std::uint16_t, 6> sigma{400, 400, 400, 300, 300, 300};
  std::array<std::int32_t, 15> correlation{};
  std::array<std::uint8_t, 16> health{};
  std::array<DotBits, 16> dots{};
};

// No pose: position and orientation say so.
void take_pose_away(Group& group);

// Any content that the layout allows, in a unit's most changeable mood: everything may be missing.
Group random_group(std::mt19937_64& random, bool fd);

// In the unit's order.
Frames frames_of(const Group& group);

dottrack_frame version_frame(std::uint8_t sequence, std::uint8_t protocol,
                             std::array<std::uint8_t, 3> version, std::uint16_t period);
dottrack_frame configuration_frame(std::uint8_t sequence, std::uint32_t hash, std::uint8_t target,
                                   std::uint8_t cameras);
dottrack_frame reply_frame(const dottrack_reply& reply, std::uint8_t sequence);

// One frame of every message type: random content, sound checksum.
// Raw numbers.
struct LightBits {
  std::uint8_t camera = 0;
  std::uint8_t state = 0;
  std::uint8_t iris = 0;
  std::uint32_t exposure = 0;
  std::uint16_t gain = 0;
  std::uint8_t opening = 0;
};
dottrack_frame light_frame(const LightBits& light, std::uint8_t sequence);
dottrack_frame random_frame(std::mt19937_64& random, unsigned message);
const std::vector<unsigned>& every_message();

// Makes the checksum right again after the content was changed.
void seal(dottrack_frame& frame);

// Over these bytes, of which the last are the data ID.
std::uint8_t profile2_crc(std::initializer_list<std::uint8_t> bytes);
std::uint16_t profile5_crc(std::initializer_list<std::uint8_t> bytes);

void put_bits(dottrack_frame& frame, unsigned start, unsigned length, std::uint64_t value);
void flip_bit(dottrack_frame& frame, unsigned bit);

}  // namespace dottrack::receiver_test
