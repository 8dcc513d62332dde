#pragma once
// Hardware that does what a test says and remembers what it was asked.

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "hal/can_bus.h"
#include "hal/frame_grabber.h"
#include "hal/iris.h"
#include "hal/output_line.h"
#include "rtos_shim/watchdog.h"

namespace dottrack::cycle::test {

class FakeGrabber final : public hal::FrameGrabber {
 public:
  std::array<ImageView, kMaxCameras> images{};  // of the next trigger; empty: does not deliver
  Duration lag{};                               // from the trigger to mid-exposure
  CameraSet expected;
  Time deadline{};
  int triggers = 0;
  int releases = 0;
  bool takes_exposures = false;
  std::array<std::optional<hal::ExposureSettings>, kMaxCameras> exposures{};  // last asked for

 private:
  void do_trigger(Time now) override {
    ++triggers;
    triggered_ = now;
  }
  const hal::FrameSet& do_await(CameraSet cameras, Time until) override {
    expected = cameras;
    deadline = until;
    set_.delivered = CameraSet{};
    for (std::size_t i = 0; i < kMaxCameras; ++i) {
      if (images[i].empty() || !cameras.contains(i)) continue;
      set_.frames[i] = {images[i], triggered_ + lag, 0};
      set_.delivered.insert(i);
    }
    return set_;
  }
  void do_release() override { ++releases; }
  bool do_set_exposure(std::size_t camera, const hal::ExposureSettings& settings) override {
    exposures[camera] = settings;
    return takes_exposures;
  }

  hal::FrameSet set_;
  Time triggered_{};
};

class FakeIris final : public hal::Iris {
 public:
  static constexpr double kAutomatic = 0.6;  // opening that the lens itself chose
  CameraSet broken;
  CameraSet released;
  bool takes_moves = false;
  std::array<int, kMaxCameras> moves{};
  std::array<double, kMaxCameras> openings{};  // where it was last sent

 private:
  bool do_move_to(std::size_t camera, double opening) override {
    ++moves[camera];
    openings[camera] = opening;
    if (takes_moves) overridden_.insert(camera);
    return takes_moves;
  }
  bool do_release_to_auto(std::size_t camera) override {
    released.insert(camera);
    overridden_.erase(camera);
    return true;
  }
  hal::IrisState do_state(std::size_t camera) const override {
    const bool overridden = overridden_.contains(camera);
    return {.opening = overridden ? openings[camera] : kAutomatic,
            .automatic = !overridden,
            .healthy = !broken.contains(camera)};
  }

  CameraSet overridden_;
};

class FakeCan final : public hal::CanBus {
 public:
  static constexpr std::size_t kRoom = 1000;
  hal::SendResult answer = hal::SendResult::accepted;
  std::size_t answer_from = 0;  // frames before this one are accepted
  std::size_t attempts = 0;
  std::array<hal::CanFrame, kRoom> sent{};
  std::size_t sent_size = 0;
  Time deadline{};
  std::deque<hal::CanFrame> heard;  // what receive() will give

 private:
  hal::SendResult do_send(const hal::CanFrame& frame, Time until) override {
    deadline = until;
    if (attempts++ >= answer_from && answer != hal::SendResult::accepted) return answer;
    sent.at(sent_size++) = frame;
    return hal::SendResult::accepted;
  }
  bool do_receive(hal::CanFrame& frame) override {
    if (heard.empty()) return false;
    frame = heard.front();
    heard.pop_front();
    return true;
  }
  hal::CanState do_state() const override { return hal::CanState::active; }
};

class FakeLine final : public hal::OutputLine {
 public:
  std::vector<bool> states;

 private:
  bool do_set(bool active) override {
    states.push_back(active);
    return true;
  }
};

class FakeWatchdog final : public rtos::Watchdog {
 public:
  int kicks = 0;

 private:
  void do_kick() override { ++kicks; }
  Duration do_timeout() const override { return std::chrono::seconds(1); }
};

}  // namespace dottrack::cycle::test
