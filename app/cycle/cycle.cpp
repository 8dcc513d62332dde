#include "app/cycle/cycle.h"

#include <algorithm>

#include "app/core/protocol/pose_encoder.h"

namespace dottrack::cycle {
namespace {

// Times one stage after another.
class Lap {
 public:
  explicit Lap(const rtos::Clock& clock) : clock_(clock), start_(clock.now()) {}

  Duration next() {
    const Time end = clock_.now();
    const Duration lap = end - start_;
    start_ = end;
    return lap;
  }

 private:
  const rtos::Clock& clock_;
  Time start_;
};

protocol::PoseMessage pose_message(const core::TickResult& result, Time stamp) {
  protocol::PoseMessage message;
  message.state = result.state;
  message.reason = result.reason;
  message.cameras_used = result.cameras_used;
  message.dots_used = result.dots_used;
  message.reset_count = static_cast<std::uint8_t>(result.reset_count);
  message.mid_exposure = stamp;
  message.pose_valid = result.has_pose;
  message.position_m = result.pose.position_m;
  message.orientation = result.pose.orientation;
  return message;
}

hal::CanFrame can_frame(const protocol::PoseFrame& pose) {
  hal::CanFrame frame;
  frame.id = pose.id;
  frame.length = static_cast<std::uint8_t>(pose.data.size());
  std::copy(pose.data.begin(), pose.data.end(), frame.data.begin());
  return frame;
}

}  // namespace

CycleSettings settings_for(std::size_t cameras, Duration period) {
  return {.cameras = cameras, .frame_deadline = period / 2, .send_deadline = period};
}

void Cycle::tick(const rtos::Wake& wake) {
  telemetry::StageTimes& took = record_.stages;
  Lap lap(parts_.stopwatch);
  record_.due = wake.due;
  record_.woke = parts_.clock.now();
  record_.counters.deadline_misses += wake.missed;

  const hal::FrameSet& frames = capture(wake.due);
  took.capture = lap.next();
  track(frames);
  took.track = lap.next();
  broadcast();
  took.broadcast = lap.next();
  expose();
  took.expose = lap.next();
  record();
  took.record = lap.next();
}

const hal::FrameSet& Cycle::capture(Time due) {
  parts_.grabber.trigger(parts_.clock.now());
  return parts_.grabber.await(CameraSet::first(settings_.cameras), due + settings_.frame_deadline);
}

void Cycle::track(const hal::FrameSet& frames) {
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    const hal::Frame& frame = frames.frames[i];
    frames_[i] = {frames.delivered.contains(i), frame.image, frame.mid_exposure};
  }
  core::TickResult& result = record_.result;
  result = tracker_->step(frames_);
  result.tick = ticks_++;
  result.reset_count += resets_before_;
  keep(frames);
  parts_.grabber.release();

  bool any = false;
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    any = any || result.cameras[i].delivered;
    if (!result.cameras[i].delivered) ++record_.counters.missing_frames[i];
  }
  record_.stamp = any ? result.capture_time : record_.due;
}

void Cycle::keep(const hal::FrameSet& frames) {
  if (parts_.frames == nullptr) return;
  if (parts_.frames->try_push(record_.result.tick, parts_.clock.now(), frames)) return;
  ++record_.counters.frames_dropped;
}

void Cycle::broadcast() {
  send(pose_message(record_.result, record_.stamp), record_.due + settings_.send_deadline);
  record_.sent = parts_.clock.now();
  record_.can_state = parts_.can.state();
}

// A group that is cut short is of no use to anyone: after the first frame that does not go out, the
// others stay at home.
void Cycle::send(const protocol::PoseMessage& message, Time deadline) {
  telemetry::CycleCounters& counters = record_.counters;
  for (const protocol::PoseFrame& frame :
       protocol::encode(message, settings_.can_base_id, group_++)) {
    const hal::SendResult sent = parts_.can.send(can_frame(frame), deadline);
    if (sent == hal::SendResult::accepted) continue;
    ++(sent == hal::SendResult::try_again ? counters.sends_without_room : counters.sends_failed);
    return;
  }
  ++counters.messages_sent;
}

// The lenses' own control is in charge of the irises; the loop notes which of them do not answer.
void Cycle::expose() {
  record_.unhealthy_irises = CameraSet{};
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    if (!parts_.iris.state(i).healthy) record_.unhealthy_irises.insert(i);
  }
}

void Cycle::record() {
  const bool tracking = record_.result.state == core::State::tracking;
  if (parts_.lamp != nullptr) parts_.lamp->set(tracking || record_.result.tick % 2 == 0);
  if (parts_.watchdog != nullptr) parts_.watchdog->kick();
  if (!parts_.records.try_push(record_)) ++record_.counters.records_dropped;
}

void Cycle::use(core::Tracker& tracker) {
  resets_before_ = record_.result.reset_count;
  tracker_ = &tracker;
}

void Cycle::farewell(Time now) {
  for (std::size_t i = 0; i < settings_.cameras; ++i) parts_.iris.release_to_auto(i);
  if (parts_.lamp != nullptr) parts_.lamp->set(false);
  core::TickResult last;
  last.reason = core::Reason::stopped;
  last.reset_count = record_.result.reset_count;
  send(pose_message(last, now), now + settings_.send_deadline);
}

}  // namespace dottrack::cycle
