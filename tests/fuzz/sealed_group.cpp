#include "tests/fuzz/sealed_group.h"

#include <span>

namespace dottrack::fuzz {
namespace {

constexpr std::uint32_t kStatus = 0, kTime = 1, kQuality = 2, kPosition = 3, kPosition2 = 4;
constexpr std::uint32_t kOrientation = 5, kVelocity = 6, kRates = 7, kSigmaPosition = 8;
constexpr std::uint32_t kCorrelation3 = 12, kCameras = 13, kDots = 32;
constexpr std::size_t kBefore = 2, kBeforeFd = 3;  // bytes of checksum and sequence

// What the fuzzer chooses for a group in one byte.
struct Shape {
  bool plausible, covariance, motion, cameras, valid;
  std::uint8_t dots;
};

Shape shape_from(ByteSource& source) {
  const std::uint8_t choice = source.byte();
  const auto bit = [&](unsigned i) { return (choice >> i & 1U) != 0; };
  Shape shape{!bit(0), bit(1), bit(2), bit(3), bit(4), 0};
  if (bit(5)) shape.dots = static_cast<std::uint8_t>(source.byte() % (DOTTRACK_MAX_DOTS + 1));
  return shape;
}

void write(dottrack_frame& frame, std::size_t at, std::size_t bytes, std::uint64_t value) {
  for (std::size_t i = 0; i < bytes; ++i) {
    frame.data[at + i] = static_cast<std::uint8_t>(value >> 8U * i & 0xFFU);
  }
}

std::uint8_t status_byte(const Shape& shape) {
  return static_cast<std::uint8_t>(DOTTRACK_PROTOCOL_VERSION | 1U << 4U |
                                   (shape.valid ? 1U << 6U : 0U));
}

std::uint8_t follow_byte(const Shape& shape) {
  return static_cast<std::uint8_t>((shape.dots & 31U) | (shape.covariance ? 1U << 5U : 0U) |
                                   (shape.motion ? 1U << 6U : 0U) |
                                   (shape.cameras ? 1U << 7U : 0U));
}

constexpr std::uint64_t kNoMetres = 0x800000, kNoComponent = 0x8000;  // not available
// Half a turn about an axis between x and y: 0.6 and 0.8 in steps of 0.000031.
constexpr std::array<std::uint64_t, 4> kHalfTurn{0, 19355, 25806, 0};

std::uint64_t component(const Shape& shape, std::size_t index) {
  return shape.valid ? kHalfTurn[index] : kNoComponent;
}

void make_plausible(dottrack_frame& frame, std::uint32_t offset, const Shape& shape) {
  if (offset == kStatus) {
    frame.data[2] = status_byte(shape);
    frame.data[6] &= 15U;
  }
  if (offset == kPosition && !shape.valid) {
    write(frame, 2, 3, kNoMetres);
    write(frame, 5, 3, kNoMetres);
  }
  if (offset == kPosition2) {
    if (!shape.valid) write(frame, 2, 3, kNoMetres);
    write(frame, 5, 2, component(shape, 0));
  }
  for (std::size_t i = 1; i < 4 && offset == kOrientation; ++i) {
    write(frame, 2 * i, 2, component(shape, i));
  }
}

void make_plausible_fd(dottrack_frame& frame, const Shape& shape, std::uint64_t capture_us) {
  frame.data[3] = status_byte(shape);
  frame.data[7] = static_cast<std::uint8_t>((frame.data[7] & 15U) | (follow_byte(shape) & 0xE0U));
  write(frame, 9, 6, capture_us);
  for (std::size_t i = 0; i < 3 && !shape.valid; ++i) write(frame, 21 + 3 * i, 3, kNoMetres);
  for (std::size_t i = 0; i < 4; ++i) write(frame, 30 + 2 * i, 2, component(shape, i));
  frame.data[50] = static_cast<std::uint8_t>((frame.data[50] & 0xE0U) | shape.dots);
}

class GroupMaker {
 public:
  GroupMaker(const dottrack_settings& settings, std::uint8_t sequence, ByteSource& source)
      : settings_(settings), sequence_(sequence), source_(source) {}

  dottrack_frame& add(std::uint32_t offset) {
    auto& frame = group.frames[group.count++];
    frame = sealed_frame(settings_, offset, sequence_, source_);
    return frame;
  }

  SealedGroup group;

 private:
  const dottrack_settings& settings_;
  std::uint8_t sequence_;
  ByteSource& source_;
};

void add_pose(GroupMaker& maker, const Shape& shape, std::uint64_t capture_us) {
  for (std::uint32_t offset = kStatus; offset <= kOrientation; ++offset) {
    dottrack_frame& frame = maker.add(offset);
    if (offset == kTime) write(frame, kBefore, 6, capture_us);
    if (offset == kQuality) frame.data[7] = follow_byte(shape);
    if (shape.plausible) make_plausible(frame, offset, shape);
    seal(frame, offset);
  }
}

void add_fd_pose(GroupMaker& maker, const Shape& shape, std::uint64_t capture_us) {
  dottrack_frame& frame = maker.add(kFdPoseOffset);
  if (shape.plausible) make_plausible_fd(frame, shape, capture_us);
  seal(frame, kFdPoseOffset);
}

void add_rest(GroupMaker& maker, const Shape& shape, bool fd) {
  const auto range = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t offset = first; offset <= last; ++offset) maker.add(offset);
  };
  if (shape.motion) range(kVelocity, kRates);
  if (shape.covariance && !fd) range(kSigmaPosition, kCorrelation3);
  if (shape.cameras) maker.add(kCameras);
  if (shape.dots > 0) range(kDots, kDots + 2U * shape.dots - 1U);
}

}  // namespace

dottrack_frame sealed_frame(const dottrack_settings& settings, std::uint32_t offset,
                            std::uint8_t sequence, ByteSource& source) {
  dottrack_frame frame{};
  frame.id = settings.base_id + offset;
  frame.extended = settings.extended;
  const bool fd = offset == kFdPoseOffset;
  frame.length = fd ? 64 : 8;
  const std::size_t before = fd ? kBeforeFd : kBefore;
  frame.data[before - 1] = sequence;
  source.fill(std::span(frame.data).subspan(before, frame.length - before));
  seal(frame, offset);
  return frame;
}

SealedGroup sealed_group(const dottrack_settings& settings, std::uint8_t sequence,
                         std::uint64_t capture_us, bool fd, ByteSource& source) {
  const Shape shape = shape_from(source);
  GroupMaker maker(settings, sequence, source);
  if (fd) {
    add_fd_pose(maker, shape, capture_us);
  } else {
    add_pose(maker, shape, capture_us);
  }
  add_rest(maker, shape, fd);
  return maker.group;
}

}  // namespace dottrack::fuzz
