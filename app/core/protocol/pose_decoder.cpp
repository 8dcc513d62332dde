#include "app/core/protocol/pose_decoder.h"

#include "app/core/protocol/pose_layout.h"

namespace dottrack::protocol {
namespace {

using namespace layout;
using Words = std::array<std::uint64_t, kFramesPerPose>;

double scaled(Field field, std::uint64_t word, double steps) {
  return static_cast<double>(get_signed(field, word)) / steps;
}

bool available(Field field, std::uint64_t word) {
  return get_signed(field, word) != field.not_available();
}

bool pose_available(const Words& words) {
  return get(kPoseValid, words[kStatus]) != 0 && available(kX, words[kPose1]) &&
         available(kY, words[kPose1]) && available(kZ, words[kPose2]) &&
         available(kQw, words[kPose2]) && available(kQx, words[kPose3]) &&
         available(kQy, words[kPose3]) && available(kQz, words[kPose3]);
}

void decode_pose(const Words& words, PoseMessage& message) {
  message.position_m = {scaled(kX, words[kPose1], kPositionStepsPerMetre),
                        scaled(kY, words[kPose1], kPositionStepsPerMetre),
                        scaled(kZ, words[kPose2], kPositionStepsPerMetre)};
  message.orientation = Eigen::Quaterniond(
      scaled(kQw, words[kPose2], kQuaternionSteps), scaled(kQx, words[kPose3], kQuaternionSteps),
      scaled(kQy, words[kPose3], kQuaternionSteps), scaled(kQz, words[kPose3], kQuaternionSteps));
  message.orientation.normalize();
}

PoseMessage decode(const Words& words) {
  const std::uint64_t status = words[kStatus];
  PoseMessage message;
  message.state = static_cast<core::State>(get(kState, status));
  message.reason = static_cast<core::Reason>(get(kReason, status));
  message.cameras_used = CameraSet(static_cast<std::uint16_t>(get(kCamerasUsed, status)));
  message.dots_used = static_cast<std::uint8_t>(get(kDotsUsed, status));
  message.reset_count = static_cast<std::uint8_t>(get(kResetCount, status));
  message.mid_exposure =
      Time(std::chrono::microseconds(static_cast<std::int64_t>(get(kMidExposureUs, words[kTime]))));
  message.pose_valid = pose_available(words);
  message.out_of_range = get(kOutOfRange, status) != 0;
  if (message.pose_valid) decode_pose(words, message);
  return message;
}

}  // namespace

std::optional<PoseMessage> PoseDecoder::push(std::uint32_t id, const Payload& data) {
  if (id < base_id_ || id - base_id_ >= kFramesPerPose) return std::nullopt;
  const std::uint32_t index = id - base_id_;
  const std::uint64_t word = to_word(data);
  const std::uint64_t counter = get(kCounter, word);
  const bool again = ((received_ >> index) & 1U) != 0;
  if (received_ != 0 && (counter != counter_ || again)) {
    ++incomplete_groups_;
    received_ = 0;
  }
  counter_ = counter;
  words_[index] = word;
  received_ |= 1U << index;
  return received_ == (1U << kFramesPerPose) - 1U ? finish() : std::nullopt;
}

std::optional<PoseMessage> PoseDecoder::finish() {
  received_ = 0;
  if (get(kVersion, words_[kStatus]) != kProtocolVersion) {
    ++foreign_versions_;
    return std::nullopt;
  }
  return decode(words_);
}

}  // namespace dottrack::protocol
