#include "tests/fuzz/checked_receiver.h"

#include <cstring>
#include <limits>
#include <numeric>

#include "tests/fuzz/pose_promises.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/sealed_frame.h"

namespace dottrack::fuzz {
namespace {

constexpr int kUntouched = 0x5A;
constexpr std::uint32_t kLight = 19;
constexpr std::uint64_t kClockPeriod_us = std::uint64_t{1} << 48U;

bool same(const dottrack_counts& a, const dottrack_counts& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same(const dottrack_frame& a, const dottrack_frame& b) {
  return a.id == b.id && a.extended == b.extended && a.length == b.length &&
         std::memcmp(a.data, b.data, sizeof a.data) == 0;
}

bool is_of_unit(const dottrack_settings& settings, const dottrack_frame& frame) {
  return frame.extended == settings.extended && frame.id >= settings.base_id &&
         frame.id - settings.base_id < DOTTRACK_IDENTIFIERS;
}

// Not Version, Configuration, Reply, Command and Light, which stand for themselves.
bool is_grouped(const dottrack_settings& settings, const dottrack_frame& frame) {
  const std::uint32_t offset = frame.id - settings.base_id;
  return offset != 14 && offset != 15 && offset != 17 && offset != 18 && offset != kLight;
}

}  // namespace

CheckedReceiver::CheckedReceiver(const dottrack_settings& settings) {
  std::memset(&receiver_, kUntouched, sizeof receiver_);
  dottrack_receiver_init(&receiver_, &settings);
}

void CheckedReceiver::push(const dottrack_frame& frame) {
  dottrack_pose pose;
  dottrack_pose untouched;
  std::memset(&pose, kUntouched, sizeof pose);
  std::memset(&untouched, kUntouched, sizeof untouched);
  const dottrack_counts before = receiver_.counts;
  Lights lights{};
  std::memcpy(lights.data(), receiver_.light, sizeof receiver_.light);
  const dottrack_verdict verdict = dottrack_receiver_push(&receiver_, &frame, now_us_, &pose);
  require(verdict >= DOTTRACK_FOREIGN && verdict <= DOTTRACK_OTHER_VERSION, "a verdict is known");
  ++given_[verdict];
  check_frame(frame, verdict);
  check_repetition(frame, verdict);
  check_lights(lights, frame, verdict);
  last_ = frame;
  check_counts(before, verdict);
  check_totals();
  const bool written = std::memcmp(&pose, &untouched, sizeof pose) != 0;
  const bool group = receiver_.counts.fresh + receiver_.counts.stale != before.fresh + before.stale;
  require(written == group, "a pose is written for a whole group that is fresh or stale");
  if (group) check_pose(pose, verdict);
}

void CheckedReceiver::poll() {
  const dottrack_counts before = receiver_.counts;
  const dottrack_verdict verdict = dottrack_receiver_poll(&receiver_, now_us_);
  require(
      verdict == DOTTRACK_INCOMPLETE || verdict == DOTTRACK_STALE || verdict == DOTTRACK_WAITING,
      "a poll ends in incomplete, stale or waiting");
  require((verdict == DOTTRACK_INCOMPLETE) == (receiver_.counts.incomplete != before.incomplete),
          "a poll counts the group that it gives up");
  require(receiver_.counts.fresh == before.fresh && receiver_.counts.frames == before.frames,
          "a poll brings nothing new");
}

void CheckedReceiver::wait(std::uint64_t duration_us) {
  const std::uint64_t left = std::numeric_limits<std::uint64_t>::max() - now_us_;
  now_us_ += duration_us < left ? duration_us : left;
  last_.reset();
}

std::uint64_t CheckedReceiver::given(dottrack_verdict verdict) const {
  return given_[verdict];
}

// What is not sound is never used.
void CheckedReceiver::check_frame(const dottrack_frame& frame, dottrack_verdict verdict) const {
  if (!is_of_unit(receiver_.settings, frame)) {
    require(verdict == DOTTRACK_FOREIGN, "a frame of others is foreign");
    return;
  }
  if (is_sealed(frame, frame.id - receiver_.settings.base_id)) return;
  require(verdict == DOTTRACK_FOREIGN || verdict == DOTTRACK_CORRUPTED,
          "a frame with a wrong checksum or length is corrupted");
}

// The same once more, at once, is nothing new; unless no silence at all is a gap.
void CheckedReceiver::check_repetition(const dottrack_frame& frame,
                                       dottrack_verdict verdict) const {
  if (!last_ || !same(*last_, frame) || receiver_.settings.restart_gap_us == 0) return;
  if (!is_grouped(receiver_.settings, frame)) return;
  require(
      verdict != DOTTRACK_WAITING && verdict != DOTTRACK_FRESH && verdict != DOTTRACK_INCOMPLETE,
      "a frame that came a moment ago is not taken again");
}

void CheckedReceiver::check_counts(const dottrack_counts& before, dottrack_verdict verdict) const {
  const dottrack_counts& after = receiver_.counts;
  const auto one_more = [&](auto count) { return after.*count - before.*count == 1; };
  using Counts = dottrack_counts;
  if (verdict == DOTTRACK_FOREIGN) {
    require(same(before, after), "a foreign frame counts nowhere");
    return;
  }
  require(one_more(&Counts::frames), "a frame of the unit counts");
  require(one_more(&Counts::fresh) == (verdict == DOTTRACK_FRESH), "fresh groups count");
  require(verdict != DOTTRACK_STALE || one_more(&Counts::stale) || one_more(&Counts::late_frames),
          "stale groups and late frames count");
  require(verdict != DOTTRACK_INCOMPLETE || after.incomplete > before.incomplete,
          "groups given up count");
  require(verdict != DOTTRACK_CORRUPTED || one_more(&Counts::corrupted), "corrupted frames count");
  require(verdict != DOTTRACK_REPEATED || one_more(&Counts::repeated_frames) ||
              one_more(&Counts::repeated_groups),
          "repeated frames and groups count");
  require(verdict != DOTTRACK_OTHER_VERSION || one_more(&Counts::other_version),
          "frames of another version count");
}

// Only a sound Light changes what is known of a camera, and of one camera alone; numbers are within
// what the message can say, or negative.
void CheckedReceiver::check_lights(const Lights& before, const dottrack_frame& frame,
                                   dottrack_verdict verdict) const {
  const bool of_light = verdict == DOTTRACK_WAITING || verdict == DOTTRACK_INCOMPLETE;
  const bool told = of_light && frame.id - receiver_.settings.base_id == kLight;
  unsigned changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const dottrack_light& light = receiver_.light[i];
    changed += std::memcmp(&before[i], &light, sizeof light) != 0 ? 1U : 0U;
    require(light.exposure_s <= 1.0486 && light.gain <= 40.95 && light.opening <= 1.0,
            "a light is within its ranges");
    require(!light.known || dottrack_iris_text(light.iris)[0] != 'u', "an iris has a word");
  }
  require(changed <= (told ? 1U : 0U), "a sound light changes what is known of one camera");
  const std::size_t camera = frame.data[2] & 0xFU;
  require(!told || receiver_.light[camera].arrival_us == now_us_, "a light arrives with its frame");
}

void CheckedReceiver::check_totals() const {
  const dottrack_counts& counts = receiver_.counts;
  const std::uint64_t known = std::accumulate(given_.begin() + 1, given_.end(), std::uint64_t{0});
  require(counts.frames == known, "each frame of the unit has one verdict");
  require(counts.fresh == given(DOTTRACK_FRESH), "as many fresh groups as verdicts");
  require(counts.corrupted == given(DOTTRACK_CORRUPTED), "as many corrupted as verdicts");
  require(counts.stale + counts.late_frames == given(DOTTRACK_STALE),
          "as many stale groups and late frames as verdicts");
  require(counts.repeated_frames + counts.repeated_groups == given(DOTTRACK_REPEATED),
          "as many repeated frames and groups as verdicts");
  require(counts.other_version == given(DOTTRACK_OTHER_VERSION),
          "as many of another version as verdicts");
}

void CheckedReceiver::check_pose(const dottrack_pose& pose, dottrack_verdict verdict) {
  require(verdict == DOTTRACK_FRESH || verdict == DOTTRACK_STALE, "a pose is fresh or stale");
  require(pose.arrival_us == now_us_, "a pose arrives with the frame that completes it");
  check_content(pose);
  if (pose.restarted) had_fresh_ = false;
  if (verdict == DOTTRACK_FRESH) check_order(pose);
}

// Fresh means young, and a pose newer than all poses before.
void CheckedReceiver::check_order(const dottrack_pose& pose) {
  require(pose.age_us <= receiver_.settings.age_limit_us, "a fresh pose is young");
  if (!pose.valid) return;
  if (had_fresh_) {
    const std::uint64_t later = (pose.capture_us - last_capture_us_) % kClockPeriod_us;
    require(later != 0 && later < kClockPeriod_us / 2, "a fresh pose is newer than those before");
  }
  had_fresh_ = true;
  last_capture_us_ = pose.capture_us;
}

}  // namespace dottrack::fuzz
