#include "tests/unit/receiver/frame_builder.h"

#include <cmath>

namespace dottrack::receiver_test {
namespace {

constexpr std::int32_t kNoPosition = -8388608;
constexpr std::int32_t kNoQuaternion = -32768;

// Bit by bit, as the standards write checksums down.
unsigned shift_in(unsigned crc, unsigned byte, unsigned width, unsigned polynomial) {
  for (unsigned bit = 0; bit < 8; ++bit) {
    const unsigned top = (crc >> (width - 1U)) & 1U;
    const unsigned next = (byte >> (7U - bit)) & 1U;
    crc = (crc << 1U) & ((1U << width) - 1U);
    if (top != next) crc ^= polynomial;
  }
  return crc;
}

dottrack_frame blank(unsigned message, std::uint8_t sequence) {
  dottrack_frame frame{};
  frame.id = DOTTRACK_DEFAULT_BASE_ID + message;
  frame.length = message == kFdPose ? 64 : 8;
  put_bits(frame, message == kFdPose ? 16 : 8, 8, sequence);
  return frame;
}

// Signals of the same length, one behind the other.
template <class Values>
void put_row(dottrack_frame& frame, unsigned start, unsigned length, const Values& values,
             std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    put_bits(frame, start + length * static_cast<unsigned>(i), length,
             static_cast<std::uint64_t>(std::int64_t{values[first + i]}));
  }
}

void put_status(dottrack_frame& frame, unsigned start, const Group& group) {
  put_bits(frame, start, 4, group.version);
  put_bits(frame, start + 4, 2, group.state);
  put_bits(frame, start + 6, 1, group.valid ? 1 : 0);
  put_bits(frame, start + 7, 1, group.out_of_range ? 1 : 0);
  put_bits(frame, start + 8, 8, group.reason);
  put_bits(frame, start + 16, 16, group.cameras_used);
  put_bits(frame, start + 32, 5, group.dots_used);
  put_bits(frame, start + 40, 8, group.reset_count);
}

void put_follow_bits(dottrack_frame& frame, const Group& group) {
  put_bits(frame, 61, 1, group.covariance ? 1 : 0);
  put_bits(frame, 62, 1, group.motion ? 1 : 0);
  put_bits(frame, 63, 1, group.cameras ? 1 : 0);
}

void add_classic_pose(const Group& group, Frames& frames) {
  const auto add = [&](unsigned message) -> dottrack_frame& {
    return frames.emplace_back(blank(message, group.sequence));
  };
  dottrack_frame& status = add(kStatus);
  put_status(status, 16, group);
  put_bits(status, 53, 2, group.kind);
  put_bits(add(kTime), 16, 48, group.capture_us);
  dottrack_frame& quality = add(kQuality);
  put_bits(quality, 16, 16, group.age);
  put_bits(quality, 32, 16, group.degraded);
  put_bits(quality, 48, 8, group.false_lock);
  put_bits(quality, 56, 5, group.dots_follow);
  put_follow_bits(quality, group);
  put_row(add(kPosition), 16, 24, group.position, 0, 2);
  dottrack_frame& position2 = add(kPosition2);
  put_row(position2, 16, 24, group.position, 2, 1);
  put_row(position2, 40, 16, group.orientation, 0, 1);
  put_bits(position2, 56, 8, group.residual);
  put_row(add(kOrientation), 16, 16, group.orientation, 1, 3);
}

void add_fd_pose(const Group& group, Frames& frames) {
  dottrack_frame& frame = frames.emplace_back(blank(kFdPose, group.sequence));
  put_status(frame, 24, group);
  put_follow_bits(frame, group);
  put_bits(frame, 72, 48, group.capture_us);
  put_bits(frame, 120, 16, group.age);
  put_bits(frame, 136, 16, group.degraded);
  put_bits(frame, 152, 8, group.false_lock);
  put_bits(frame, 160, 8, group.residual);
  put_row(frame, 168, 24, group.position, 0, 3);
  put_row(frame, 240, 16, group.orientation, 0, 4);
  put_row(frame, 304, 16, group.sigma, 0, 6);
  put_bits(frame, 400, 5, group.dots_follow);
  put_row(frame, 405, 7, group.correlation, 0, 15);
  put_bits(frame, 510, 2, group.kind);
}

void add_motion(const Group& group, Frames& frames) {
  put_row(frames.emplace_back(blank(6, group.sequence)), 16, 16, group.velocity, 0, 3);
  put_row(frames.emplace_back(blank(7, group.sequence)), 16, 16, group.rates, 0, 3);
}

void add_covariance(const Group& group, Frames& frames) {
  for (unsigned i = 0; i < 2; ++i) {
    put_row(frames.emplace_back(blank(8 + i, group.sequence)), 16, 16, group.sigma, 3U * i, 3);
  }
  for (unsigned i = 0; i < 3; ++i) {
    put_row(frames.emplace_back(blank(10 + i, group.sequence)), 16, 9, group.correlation, 5U * i,
            5);
  }
}

void add_dot(const Group& group, unsigned index, Frames& frames) {
  const DotBits& dot = group.dots[index];
  put_row(frames.emplace_back(blank(kFirstDot + 2 * index, group.sequence)), 16, 24, dot.position,
          0, 2);
  dottrack_frame& detail = frames.emplace_back(blank(kFirstDot + 2 * index + 1, group.sequence));
  put_row(detail, 16, 24, dot.position, 2, 1);
  put_bits(detail, 40, 16, dot.cameras);
  put_bits(detail, 56, 2, dot.visibility);
  put_bits(detail, 58, 6, dot.sigma);
}

template <class Number>
Number pick(std::mt19937_64& random, std::int64_t least, std::int64_t most) {
  return static_cast<Number>(std::uniform_int_distribution<std::int64_t>(least, most)(random));
}

// One in eight is "not available".
std::int32_t pick_or_none(std::mt19937_64& random, std::int32_t most, std::int32_t none) {
  return random() % 8 == 0 ? none : pick<std::int32_t>(random, -most, most);
}

std::array<std::int32_t, 4> pick_quaternion(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::array<double, 4> q{};
  double norm = 0.0;
  for (double& component : q) component = normal(random);
  for (const double component : q) norm += component * component;
  std::array<std::int32_t, 4> raw{};
  for (std::size_t i = 0; i < 4; ++i) {
    raw[i] = static_cast<std::int32_t>(std::lround(q[i] / std::sqrt(norm) / 0.000031));
  }
  return raw;
}

void pick_covariance(std::mt19937_64& random, Group& group) {
  const bool none = random() % 4 == 0;
  const std::int32_t limit = group.fd ? 62 : 250;
  for (auto& sigma : group.sigma) sigma = none ? 65535 : pick<std::uint16_t>(random, 0, 65534);
  for (auto& value : group.correlation) {
    value = none ? (group.fd ? -64 : -256) : pick<std::int32_t>(random, -limit, limit);
  }
}

void pick_dots(std::mt19937_64& random, Group& group) {
  for (DotBits& dot : group.dots) {
    dot.visibility = pick<std::uint8_t>(random, 0, 2);
    for (auto& value : dot.position) {
      value = dot.visibility == 0 ? kNoPosition : pick<std::int32_t>(random, -8388607, 8388607);
    }
    dot.cameras = pick<std::uint16_t>(random, 0, 65535);
    dot.sigma = pick<std::uint8_t>(random, 0, 63);
  }
}

}  // namespace

void put_bits(dottrack_frame& frame, unsigned start, unsigned length, std::uint64_t value) {
  for (unsigned i = 0; i < length; ++i) {
    const unsigned bit = start + i;
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    const bool one = ((value >> i) & 1U) != 0;
    std::uint8_t& byte = frame.data[bit / 8];
    byte = static_cast<std::uint8_t>(one ? byte | mask : byte & ~mask);
  }
}

void flip_bit(dottrack_frame& frame, unsigned bit) {
  frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ (1U << (bit % 8)));
}

std::uint8_t profile2_crc(std::initializer_list<std::uint8_t> bytes) {
  unsigned crc = 0xFF;
  for (const std::uint8_t byte : bytes) crc = shift_in(crc, byte, 8, 0x2F);
  return static_cast<std::uint8_t>(crc ^ 0xFFU);
}

std::uint16_t profile5_crc(std::initializer_list<std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) crc = shift_in(crc, byte, 16, 0x1021);
  return static_cast<std::uint16_t>(crc);
}

void seal(dottrack_frame& frame) {
  const unsigned message = frame.id - DOTTRACK_DEFAULT_BASE_ID;
  if (message == kFdPose) {
    unsigned crc = 0xFFFF;
    for (unsigned i = 2; i < 64; ++i) crc = shift_in(crc, frame.data[i], 16, 0x1021);
    crc = shift_in(shift_in(crc, 0x7A, 16, 0x1021), 0xD0, 16, 0x1021);
    return put_bits(frame, 0, 16, crc);
  }
  const auto& d = frame.data;
  put_bits(frame, 0, 8,
           profile2_crc(
               {d[1], d[2], d[3], d[4], d[5], d[6], d[7], static_cast<std::uint8_t>(message + 1)}));
}

void take_pose_away(Group& group) {
  group.valid = false;
  group.position.fill(kNoPosition);
  group.orientation.fill(kNoQuaternion);
}

Group random_group(std::mt19937_64& random, bool fd) {
  Group group;
  group.fd = fd;
  group.state = pick<std::uint8_t>(random, 0, 1);
  group.reason = pick<std::uint8_t>(random, 0, 255);
  group.cameras_used = pick<std::uint16_t>(random, 0, 65535);
  group.dots_used = pick<std::uint8_t>(random, 0, 16);
  group.kind = pick<std::uint8_t>(random, 0, 3);
  group.reset_count = pick<std::uint8_t>(random, 0, 255);
  group.capture_us = random() & kClockMask;
  group.age = pick<std::uint16_t>(random, 0, 2000);
  group.degraded = pick<std::uint16_t>(random, 0, 65535);
  group.false_lock = pick<std::uint8_t>(random, 0, 255);
  group.dots_follow = random() % 2 == 0 ? pick<std::uint8_t>(random, 0, 16) : std::uint8_t{0};
  group.covariance = random() % 2 == 0;
  group.motion = random() % 2 == 0;
  group.cameras = random() % 2 == 0;
  for (auto& value : group.position) value = pick<std::int32_t>(random, -8388607, 8388607);
  group.orientation = pick_quaternion(random);
  group.residual = pick<std::uint8_t>(random, 0, 255);
  for (auto& value : group.velocity) value = pick_or_none(random, 32767, -32768);
  for (auto& value : group.rates) value = pick_or_none(random, 32767, -32768);
  pick_covariance(random, group);
  for (auto& value : group.health) value = pick<std::uint8_t>(random, 0, 7);
  pick_dots(random, group);
  if (random() % 4 == 0) take_pose_away(group);
  return group;
}

Frames frames_of(const Group& group) {
  Frames frames;
  if (group.fd) {
    add_fd_pose(group, frames);
  } else {
    add_classic_pose(group, frames);
  }
  if (group.motion) add_motion(group, frames);
  if (group.covariance && !group.fd) add_covariance(group, frames);
  if (group.cameras) {
    put_row(frames.emplace_back(blank(kCameras, group.sequence)), 16, 3, group.health, 0, 16);
  }
  for (unsigned i = 0; i < group.dots_follow && group.dots_follow <= 16; ++i) {
    add_dot(group, i, frames);
  }
  for (dottrack_frame& frame : frames) seal(frame);
  return frames;
}

dottrack_frame version_frame(std::uint8_t sequence, std::uint8_t protocol,
                             std::array<std::uint8_t, 3> version, std::uint16_t period) {
  dottrack_frame frame = blank(kVersion, sequence);
  put_bits(frame, 16, 8, protocol);
  put_row(frame, 24, 8, version, 0, 3);
  put_bits(frame, 48, 16, period);
  seal(frame);
  return frame;
}

dottrack_frame configuration_frame(std::uint8_t sequence, std::uint32_t hash, std::uint8_t target,
                                   std::uint8_t cameras) {
  dottrack_frame frame = blank(kConfiguration, sequence);
  put_bits(frame, 16, 32, hash);
  put_bits(frame, 48, 8, target);
  put_bits(frame, 56, 5, cameras);
  seal(frame);
  return frame;
}

dottrack_frame reply_frame(const dottrack_reply& reply, std::uint8_t sequence) {
  dottrack_frame frame = blank(kReply, sequence);
  put_bits(frame, 16, 8, reply.command);
  put_bits(frame, 24, 8, reply.result);
  put_bits(frame, 32, 16, reply.token);
  put_bits(frame, 48, 8, reply.accepted);
  put_bits(frame, 56, 8, reply.rejected);
  seal(frame);
  return frame;
}

dottrack_frame light_frame(const LightBits& light, std::uint8_t sequence) {
  dottrack_frame frame = blank(kLight, sequence);
  put_bits(frame, 16, 4, light.camera);
  put_bits(frame, 20, 3, light.state);
  put_bits(frame, 23, 2, light.iris);
  put_bits(frame, 25, 20, light.exposure);
  put_bits(frame, 45, 12, light.gain);
  put_bits(frame, 57, 7, light.opening);
  seal(frame);
  return frame;
}

dottrack_frame random_frame(std::mt19937_64& random, unsigned message) {
  dottrack_frame frame = blank(message, 0);
  for (unsigned i = 0; i < frame.length; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(random());
  }
  seal(frame);
  return frame;
}

const std::vector<unsigned>& every_message() {
  static const std::vector<unsigned> kMessages = [] {
    std::vector<unsigned> messages;
    for (unsigned message = 0; message <= kLight; ++message) messages.push_back(message);
    for (unsigned message = kFirstDot; message < 64; ++message) messages.push_back(message);
    return messages;
  }();
  return kMessages;
}

}  // namespace dottrack::receiver_test
