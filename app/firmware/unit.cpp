#include "app/firmware/unit.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "app/config/light.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"
#include "rtos_shim/posix_rt/posix_periodic_timer.h"

namespace dottrack::firmware {
namespace {

using std::chrono::milliseconds;

// The drivers' threads come before the irises' and after the loop's.
constexpr int kDriversBelowLoop = 10;
constexpr int kIrisesBelowLoop = 20;
constexpr std::size_t kLoopStack_bytes = 1024 * 1024;
constexpr std::size_t kRecordedTicks = 8;  // that may wait for the disk

int below(int priority, int steps) {
  return std::max(1, priority - steps);
}

std::vector<telemetry::FrameSize> frame_sizes(const config::RigConfig& config) {
  std::vector<telemetry::FrameSize> sizes;
  for (const core::Camera& camera : config.rig.cameras) {
    sizes.push_back({camera.width_px, camera.height_px});
  }
  return sizes;
}

bool same_pictures(const config::RigConfig& a, const config::RigConfig& b) {
  if (a.cameras.size() != b.cameras.size()) return false;
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    const core::Camera& left = a.rig.cameras[i];
    const core::Camera& right = b.rig.cameras[i];
    const bool same = a.cameras[i].name == b.cameras[i].name && left.width_px == right.width_px &&
                      left.height_px == right.height_px;
    if (!same) return false;
  }
  return true;
}

// With less than was asked for only where that is allowed: without the priority, else without the
// processor of its own, else without both.
Result<void> start_thread(rtos::PosixThread& thread, const rtos::ThreadSettings& wanted,
                          const std::function<void()>& body, Degradation& degradation) {
  const Result<void> started = thread.start(wanted, body);
  if (started || !degradation.accepts(started.error())) return started;
  rtos::ThreadSettings less = wanted;
  less.fifo_priority.reset();
  const Result<void> without_priority = thread.start(less, body);
  if (without_priority) return {};
  less = wanted;
  less.cpu.reset();
  if (thread.start(less, body)) return {};
  if (!degradation.accepts(without_priority.error())) return without_priority;
  less.fifo_priority.reset();
  return thread.start(less, body);
}

}  // namespace

Unit::Unit(const config::RigConfig& config)
    : loaded_(std::make_unique<LoadedTracker>(config)),
      records_(std::make_unique<telemetry::RecordRing>()),
      light_(loaded_->config.rig, config::light_settings(config)) {
  if (config.unit.recording && config.unit.recording->frames) {
    frames_ = std::make_unique<telemetry::FrameRing>(frame_sizes(config), kRecordedTicks);
  }
}

Unit::~Unit() {
  stop();
}

Result<std::unique_ptr<Unit>> Unit::open(const config::RigConfig& config,
                                         Degradation& degradation) {
  std::unique_ptr<Unit> unit(new Unit(config));
  if (auto done = unit->open_devices(degradation); !done) {
    return tl::unexpected<Error>(done.error());
  }
  return unit;
}

// A library's own threads take over the scheduling of the thread that opens it.
Result<void> Unit::open_devices(Degradation& degradation) {
  rtos::PosixThread opener;
  Result<std::unique_ptr<Hardware>> opened = fail("the devices were not opened");
  const int priority = below(config().unit.loop.priority, kDriversBelowLoop);
  auto started = start_thread(
      opener, {.name = "dottrack-open", .fifo_priority = priority},
      [&] { opened = Hardware::open(config(), clock_); }, degradation);
  if (!started) return started;
  opener.join();
  if (!opened) return tl::unexpected<Error>(opened.error());
  hardware_ = std::move(*opened);
  return {};
}

void Unit::make_cycle(rtos::Watchdog* watchdog, const Continuity& before) {
  protocol::BroadcastSettings broadcast = loaded_->broadcast;
  broadcast.first_sequence = before.sequence;
  cycle::CycleSettings settings = cycle::settings_for(config().rig, period_of(config()), broadcast);
  settings.resets_before = before.resets;
  resets_ = before.resets;
  Hardware& hardware = *hardware_;
  cycle_.emplace(cycle::CycleParts{.grabber = *hardware.cameras,
                                   .iris = *hardware.irises,
                                   .can = *hardware.can,
                                   .tracker = loaded_->tracker,
                                   .clock = clock_,
                                   .stopwatch = clock_,
                                   .records = *records_,
                                   .frames = frames_.get(),
                                   .lamp = hardware.lamp.get(),
                                   .watchdog = watchdog,
                                   .requests = &requests_,
                                   .light = &light_},
                 settings);
}

Result<void> Unit::start(rtos::Watchdog* watchdog, const Continuity& before,
                         Degradation& degradation) {
  make_cycle(watchdog, before);
  bool has_irises = false;
  for (std::size_t i = 0; i < config().cameras.size(); ++i) {
    const auto& iris = config().unit.cameras[i].iris;
    if (!iris) continue;
    hardware_->irises->move_to(i, iris->opening);
    has_irises = true;
  }
  const config::LoopConfig& loop = config().unit.loop;
  if (has_irises) {
    const int priority = below(loop.priority, kIrisesBelowLoop);
    auto started = start_thread(
        iris_thread_, {.name = "dottrack-iris", .fifo_priority = priority},
        [this] { run_irises(); }, degradation);
    if (!started) return started;
  }
  auto started = start_thread(
      loop_thread_,
      {.name = "dottrack-loop",
       .fifo_priority = loop.priority,
       .cpu = loop.cpu,
       .stack_bytes = kLoopStack_bytes},
      [this] { run_loop(); }, degradation);
  not_real_time_ = !degradation.lacks().empty();
  return started;
}

void Unit::stop() {
  ending_ = true;
  loop_thread_.join();
  irises_ending_ = true;
  iris_thread_.join();
}

Continuity Unit::continuity() const {
  return {resets(), cycle_ ? cycle_->next_sequence() : std::uint8_t{0}};
}

bool Unit::takes(const config::RigConfig& other) const {
  const config::RigConfig& own = config();
  return own.frame_rate_hz == other.frame_rate_hz && own.unit == other.unit &&
         own.targets.size() == other.targets.size() &&
         config::most_dots(own) == config::most_dots(other) && same_pictures(own, other);
}

void Unit::exchange(config::RigConfig config) {
  auto next = std::make_unique<LoadedTracker>(std::move(config));
  next_ = next.get();
  // The loop takes it at its next tick.
  while (next_.load() != nullptr) std::this_thread::sleep_for(milliseconds(1));
  loaded_ = std::move(next);
}

void Unit::run_loop() {
  const Duration period = period_of(config());
  rtos::PosixPeriodicTimer timer(clock_.now() + period, period);
  while (!ending_) {
    const rtos::Wake wake = timer.wait();
    if (LoadedTracker* next = next_.load()) {
      light_.look_for(next->config.rig);
      cycle_->use(next->tracker, next->config.rig.target.dots.size(), next->broadcast.identity);
      next_ = nullptr;
    }
    if (not_real_time_) cycle_->degrade(protocol::Degraded::not_real_time);
    const rtos::AllocationTrap::Scope armed;
    cycle_->tick(wake);
    heap_calls_ += armed.calls().total();
    ++ticks_;
    resets_ = cycle_->resets();
  }
  cycle_->farewell(clock_.now());
}

void Unit::run_irises() {
  drivers::GpioIris& irises = *hardware_->irises;
  rtos::PosixPeriodicTimer timer(clock_.now(), irises.step_period());
  while (!irises_ending_) {
    timer.wait();
    irises.advance(clock_.now());
  }
}

}  // namespace dottrack::firmware
