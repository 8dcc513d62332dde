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
  record_.counters.deadline_misses += wake.missed;

  const hal::FrameSet& frames = capture(wake.due);
  took.capture = lap.next();
  const core::TickResult& result = track(frames);
  took.track = lap.next();
  broadcast(result);
  took.broadcast = lap.next();
  expose();
  took.expose = lap.next();
  record(result);
  took.record = lap.next();
}

const hal::FrameSet& Cycle::capture(Time due) {
  parts_.grabber.trigger(parts_.clock.now());
  return parts_.grabber.await(CameraSet::first(settings_.cameras), due + settings_.frame_deadline);
}

const core::TickResult& Cycle::track(const hal::FrameSet& frames) {
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    const hal::Frame& frame = frames.frames[i];
    frames_[i] = {frames.delivered.contains(i), frame.image, frame.mid_exposure};
  }
  const core::TickResult& result = parts_.tracker.step(frames_);
  parts_.grabber.release();

  bool any = false;
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    any = any || result.cameras[i].delivered;
    if (!result.cameras[i].delivered) ++record_.counters.missing_frames[i];
  }
  record_.stamp = any ? result.capture_time : record_.due;
  return result;
}

// A group that is cut short is of no use to anyone: after the first frame that does not go out, the
// others stay at home.
void Cycle::broadcast(const core::TickResult& result) {
  const Time deadline = record_.due + settings_.send_deadline;
  telemetry::CycleCounters& counters = record_.counters;
  for (const protocol::PoseFrame& frame :
       protocol::encode(pose_message(result, record_.stamp), settings_.can_base_id, group_++)) {
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

void Cycle::record(const core::TickResult& result) {
  record_.result = result;
  if (!parts_.records.try_push(record_)) ++record_.counters.records_dropped;
}

}  // namespace dottrack::cycle
