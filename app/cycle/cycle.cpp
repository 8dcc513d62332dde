#include "app/cycle/cycle.h"

#include <span>

#include "app/cycle/pose_report.h"

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

}  // namespace

CycleSettings settings_for(const core::Rig& rig, Duration period,
                           const protocol::BroadcastSettings& broadcast) {
  return {.cameras = rig.cameras.size(),
          .frame_deadline = period / 2,
          .send_deadline = period,
          .dots = rig.target.dots.size(),
          .broadcast = broadcast};
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
  tracker_resets_ = result.reset_count;
  result.reset_count = resets();
  read_light();
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
  const Time deadline = record_.due + settings_.send_deadline;
  const telemetry::CycleCounters before = record_.counters;
  const RigSize rig{settings_.cameras, settings_.dots};
  const Time now = parts_.clock.now();
  const protocol::PoseChoice choice = settings_.broadcast.pose;
  const core::FilteredPose ahead =
      choice == protocol::PoseChoice::predicted ? tracker_->predicted(now) : core::FilteredPose{};
  const SentPose sent = chosen_pose(record_, choice, ahead, now);
  if (broadcaster_.tell(pose_report(record_, sent, rig, told_, now), deadline, record_.counters)) {
    told_ = before;
    // The light is that of the tick before: exposure is decided after the pose is out.
    broadcaster_.tell_light(std::span(record_.light).first(settings_.cameras), deadline,
                            record_.counters);
  }
  obey(deadline);
  record_.sent = parts_.clock.now();
  record_.can_state = parts_.can.state();
}

void Cycle::obey(Time deadline) {
  if (const auto command = broadcaster_.listen(parts_.clock.now(), deadline)) {
    broadcaster_.reply(carry_out(*command), deadline);
  }
  record_.counters.commands = broadcaster_.command_counts();
}

bool Cycle::carry_out(const protocol::Command& command) {
  switch (command.code) {
    case protocol::CommandCode::acquire:
      tracker_->forget();
      return true;
    case protocol::CommandCode::set_target:
      if (parts_.requests == nullptr) return false;
      parts_.requests->ask_for_target(command.argument);
      return true;
    case protocol::CommandCode::report_version:
      broadcaster_.identify();
      return true;
  }
  return false;
}

// While the images are there.
void Cycle::read_light() {
  if (parts_.light == nullptr) return;
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    parts_.light->read(i, frames_[i], record_.result);
  }
  parts_.light->end_readings(record_.result);
}

// Without light control the lenses' own control is in charge of the irises; the loop notes which
// of them do not answer.
void Cycle::expose() {
  record_.unhealthy_irises = CameraSet{};
  for (std::size_t i = 0; i < settings_.cameras; ++i) {
    const hal::IrisState iris = parts_.iris.state(i);
    if (parts_.light != nullptr) control_light(i, iris);
    const bool fault = record_.light[i].state == exposure::LightState::iris_fault;
    if (!iris.healthy || fault) record_.unhealthy_irises.insert(i);
  }
}

void Cycle::control_light(std::size_t camera, const hal::IrisState& iris) {
  exposure::LightControl& light = *parts_.light;
  const exposure::CameraOrders orders =
      light.decide(camera, {iris.opening, iris.moving, iris.automatic, iris.healthy});
  if (orders.exposure &&
      !parts_.grabber.set_exposure(camera, {orders.exposure->exposure, orders.exposure->gain})) {
    light.exposure_refused(camera);
  }
  switch (orders.iris.act) {
    case exposure::IrisAct::none:
      break;
    case exposure::IrisAct::move:
      if (!parts_.iris.move_to(camera, orders.iris.opening)) light.iris_refused(camera);
      break;
    case exposure::IrisAct::release:
      parts_.iris.release_to_auto(camera);
      break;
  }
  record_.light[camera] = light.light(camera);
}

void Cycle::record() {
  const bool tracking = record_.result.state == core::State::tracking;
  if (parts_.lamp != nullptr) parts_.lamp->set(tracking || record_.result.tick % 2 == 0);
  if (parts_.watchdog != nullptr) parts_.watchdog->kick();
  if (!parts_.records.try_push(record_)) ++record_.counters.records_dropped;
}

void Cycle::use(core::Tracker& tracker, std::size_t dots,
                const protocol::IdentityMessage& identity) {
  resets_before_ = resets();
  tracker_resets_ = 0;
  tracker_ = &tracker;
  settings_.dots = dots;
  broadcaster_.identify_as(identity);
}

void Cycle::farewell(Time now) {
  for (std::size_t i = 0; i < settings_.cameras; ++i) parts_.iris.release_to_auto(i);
  if (parts_.lamp != nullptr) parts_.lamp->set(false);
  protocol::PoseMessage last;
  last.reason = core::Reason::stopped;
  last.reset_count = static_cast<std::uint8_t>(resets());
  last.mid_exposure = now;
  broadcaster_.part(last, now + settings_.send_deadline, record_.counters);
}

}  // namespace dottrack::cycle
