#include "app/core/protocol/pose_encoder.h"

#include <algorithm>

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/fd_pose.h"
#include "app/core/protocol/frame_writer.h"
#include "app/core/protocol/raw_pose.h"

namespace dottrack::protocol {
namespace {

using namespace layout;

static_assert(kBaseId == kDefaultBaseId);

// Signals that are alike and lie one after the other.
constexpr bool in_a_row(const Signal& first, const Signal& last, unsigned count) {
  return last.length == first.length && last.factor == first.factor &&
         last.start == first.start + (count - 1) * first.length;
}
static_assert(in_a_row(velocity::kVX, velocity::kVZ, 3));
static_assert(in_a_row(rates::kWX, rates::kWZ, 3));
static_assert(in_a_row(sigma_position::kSigmaX, sigma_position::kSigmaZ, 3));
static_assert(in_a_row(sigma_attitude::kSigmaRoll, sigma_attitude::kSigmaYaw, 3));
static_assert(sigma_attitude::kSigmaRoll.factor == sigma_position::kSigmaX.factor);
static_assert(in_a_row(correlation1::kCorrXY, correlation1::kCorrXYaw, 5));
static_assert(in_a_row(correlation2::kCorrYZ, correlation2::kCorrZRoll, 5));
static_assert(in_a_row(correlation3::kCorrZPitch, correlation3::kCorrPitchYaw, 5));
static_assert(in_a_row(cameras::kCamera1, cameras::kCamera16, kMaxCameras));
static_assert(dot16_position::kMessage == dot1_position::kMessage.further(30));
static_assert(dot16_detail::kMessage == dot1_detail::kMessage.further(30));

constexpr CovarianceSignals kClassicCovariance{sigma_position::kSigmaX, correlation1::kCorrXY};

std::uint64_t flag(const Field& field, bool set) {
  return put(field, set ? 1 : 0);
}

template <class Raws>
std::uint64_t put_row(const Field& first, const Raws& raws, std::size_t begin, std::size_t count) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < count; ++i) {
    word |=
        put({first.start + static_cast<unsigned>(i) * first.length, first.length}, raws[begin + i]);
  }
  return word;
}

std::uint64_t status_word(const PoseMessage& message, const RawPose& pose) {
  namespace s = layout::status;
  return put(s::kVersion, kProtocolVersion) |
         put(s::kState, static_cast<std::uint64_t>(message.state)) |
         flag(s::kPoseValid, pose.valid) | flag(s::kOutOfRange, pose.out_of_range) |
         put(s::kReason, static_cast<std::uint64_t>(message.reason)) |
         put(s::kCamerasUsed, message.cameras_used.bits()) |
         put(s::kDotsUsed, std::min<std::uint64_t>(message.dots_used, core::kMaxDots)) |
         put(s::kPoseKind, static_cast<std::uint64_t>(message.kind)) |
         put(s::kResetCount, message.reset_count);
}

std::uint64_t quality_word(const RawPose& pose, const GroupParts& parts, std::uint64_t dots) {
  namespace s = layout::quality;
  return put(s::kAge, pose.age) | put(s::kDegraded, pose.degraded) |
         put(s::kFalseLock, pose.false_lock) | put(s::kDotsFollow, dots) |
         flag(s::kCovarianceFollows, parts.covariance) | flag(s::kMotionFollows, parts.motion) |
         flag(s::kCamerasFollow, parts.cameras);
}

class Group {
 public:
  Group(const Addressing& addressing, std::uint8_t sequence, GroupFrames& frames)
      : writer_(addressing, sequence), frames_(frames) {}

  void classic_pose(const PoseMessage& message, const RawPose& pose, const GroupParts& parts,
                    std::uint64_t dots) {
    add(status::kMessage, status_word(message, pose));
    add(layout::time::kMessage, put(layout::time::kMidExposure, pose.mid_exposure));
    add(quality::kMessage, quality_word(pose, parts, dots));
    add(position::kMessage,
        put(position::kX, pose.position[0]) | put(position::kY, pose.position[1]));
    add(position2::kMessage, put(position2::kZ, pose.position[2]) |
                                 put(position2::kQW, pose.quaternion_wxyz[0]) |
                                 put(position2::kResidual, pose.residual));
    add(orientation::kMessage, put_row(orientation::kQX, pose.quaternion_wxyz, 1, 3));
  }

  void fd_pose(const PoseMessage& message, const RawPose& pose, const GroupParts& parts,
               std::uint64_t dots) {
    LongPayload payload = fd_pose_payload(message, pose, parts, dots);
    writer_.write(layout::fd_pose::kMessage, payload, frames_.emplace_back());
  }

  void motion(const RawMotion& motion) {
    add(velocity::kMessage, put_row(velocity::kVX, motion.velocity, 0, 3));
    add(rates::kMessage, put_row(rates::kWX, motion.rates, 0, 3));
  }

  void covariance(const RoundedCovariance& c) {
    add(sigma_position::kMessage, put_row(sigma_position::kSigmaX, c.sigmas, 0, 3));
    add(sigma_attitude::kMessage, put_row(sigma_attitude::kSigmaRoll, c.sigmas, 3, 3));
    add(correlation1::kMessage, put_row(correlation1::kCorrXY, c.correlations, 0, 5));
    add(correlation2::kMessage, put_row(correlation2::kCorrYZ, c.correlations, 5, 5));
    add(correlation3::kMessage, put_row(correlation3::kCorrZPitch, c.correlations, 10, 5));
  }

  void cameras(const std::array<CameraHealth, kMaxCameras>& health) {
    std::array<std::uint64_t, kMaxCameras> raws{};
    for (std::size_t i = 0; i < raws.size(); ++i) raws[i] = static_cast<std::uint64_t>(health[i]);
    add(cameras::kMessage, put_row(cameras::kCamera1, raws, 0, raws.size()));
  }

  void dot(std::uint32_t index, const DotReport& dot) {
    namespace s = layout::dot1_detail;
    const RawDot raw = raw_dot(dot);
    add(dot1_position::kMessage.further(2 * index),
        put(dot1_position::kX, raw.position[0]) | put(dot1_position::kY, raw.position[1]));
    add(s::kMessage.further(2 * index),
        put(s::kZ, raw.position[2]) | put(s::kCameras, dot.cameras.bits()) |
            put(s::kVisibility, static_cast<std::uint64_t>(dot.visibility)) |
            put(s::kSigma, raw.sigma));
  }

 private:
  void add(const Message& message, std::uint64_t word) {
    writer_.write(message, word, frames_.emplace_back());
  }

  FrameWriter writer_;
  GroupFrames& frames_;
};

}  // namespace

void encode_group(const PoseMessage& message, const GroupParts& parts, const Addressing& addressing,
                  std::uint8_t sequence, GroupFrames& frames) {
  frames.clear();
  Group group(addressing, sequence, frames);
  const RawPose pose = raw_pose(message, addressing.fd ? kFdCovariance : kClassicCovariance);
  const auto dots = static_cast<std::uint32_t>(
      parts.dots ? std::min<std::size_t>(message.dots_known, core::kMaxDots) : 0);
  if (addressing.fd) {
    group.fd_pose(message, pose, parts, dots);
  } else {
    group.classic_pose(message, pose, parts, dots);
  }
  if (parts.motion) group.motion(raw_motion(message, pose.valid));
  if (parts.covariance && !addressing.fd) group.covariance(pose.covariance);
  if (parts.cameras) group.cameras(message.cameras);
  for (std::uint32_t i = 0; i < dots; ++i) group.dot(i, message.dots[i]);
}

IdentityFrames encode_identity(const IdentityMessage& message, const Addressing& addressing,
                               std::uint8_t sequence) {
  namespace v = layout::version;
  namespace c = layout::configuration;
  const FrameWriter writer(addressing, sequence);
  IdentityFrames frames{};
  writer.write(v::kMessage,
               put(v::kProtocol, kProtocolVersion) | put(v::kMajor, message.major) |
                   put(v::kMinor, message.minor) | put(v::kPatch, message.patch) |
                   put(v::kGroupPeriod, raw_group_period(message.group_period)),
               frames[0]);
  writer.write(c::kMessage,
               put(c::kConfigHash, message.config_hash) | put(c::kTarget, message.target) |
                   put(c::kCameras, std::min<std::uint64_t>(message.cameras, kMaxCameras)),
               frames[1]);
  return frames;
}

}  // namespace dottrack::protocol
