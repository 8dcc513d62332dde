#pragma once
// A loop around hardware that does what a test says, before four cameras that see a target of
// discs.

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/cycle/cycle.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "rtos_shim/virtual_time/virtual_periodic_timer.h"
#include "tests/support/bus_listener.h"
#include "tests/support/disc_scene.h"
#include "tests/unit/cycle/fake_hardware.h"

namespace dottrack::cycle::test {

using dottrack::test::BusListener;
using dottrack::test::DiscScene;
using dottrack::test::GreyImage;
using std::chrono::milliseconds;

inline constexpr Duration kPeriod = milliseconds(20);
inline constexpr std::size_t kCameras = 4;

// Ticks a millisecond each time it is read.
class Stopwatch final : public rtos::Clock {
 private:
  Time do_now() const override { return Time(milliseconds(++reads_)); }
  mutable int reads_ = 0;
};

class CycleTest : public testing::Test {
 protected:
  void show(std::uint64_t tick) {
    for (std::size_t i = 0; i < kCameras; ++i) {
      shown_[i] = scene_.image_at(i, tick);
      grabber_.images[i] = shown_[i].view();
    }
  }

  const telemetry::CycleRecord& tick() {
    cycle_.tick(timer_.wait());
    if (!ring_->try_pop(record_)) throw std::runtime_error("the tick left no record");
    return record_;
  }

  // All that went out, as a vehicle hears it.
  BusListener listen() {
    BusListener listener;
    for (std::size_t i = 0; i < can_.sent_size; ++i) listener.hear(can_.sent[i]);
    return listener;
  }

  std::optional<dottrack_pose> last_message() {
    const BusListener listener = listen();
    return listener.poses().empty() ? std::nullopt : std::optional(listener.poses().back());
  }

  DiscScene scene_;
  std::array<GreyImage, kCameras> shown_;
  FakeGrabber grabber_;
  FakeIris iris_;
  FakeCan can_;
  core::Tracker tracker_{scene_.rig()};
  rtos::VirtualClock clock_;
  rtos::VirtualPeriodicTimer timer_{clock_, Time(milliseconds(100)), kPeriod};
  Stopwatch stopwatch_;
  std::unique_ptr<telemetry::RecordRing> ring_ = std::make_unique<telemetry::RecordRing>();
  Cycle cycle_{{grabber_, iris_, can_, tracker_, clock_, stopwatch_, *ring_},
               settings_for(scene_.rig(), kPeriod)};
  telemetry::CycleRecord record_;
};

}  // namespace dottrack::cycle::test
