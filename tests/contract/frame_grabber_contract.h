#pragma once
// What every FrameGrabber promises.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "hal/frame_grabber.h"

namespace dottrack::test {

// A grabber of kCameras cameras of kWidth_px x kHeight_px, and a hand on what they deliver.
class GrabberBench {
 public:
  static constexpr std::size_t kCameras = 3;
  static constexpr int kWidth_px = 16;
  static constexpr int kHeight_px = 12;

  GrabberBench() = default;
  GrabberBench(const GrabberBench&) = delete;
  GrabberBench& operator=(const GrabberBench&) = delete;
  virtual ~GrabberBench() = default;

  virtual hal::FrameGrabber& grabber() = 0;
  virtual Time now() const = 0;
  // Before a trigger: these cameras, and no others, will deliver in time.
  virtual void prepare(CameraSet delivering) = 0;
};

struct GrabberCase {
  std::string name;
  std::function<std::unique_ptr<GrabberBench>()> make;
};
inline void PrintTo(const GrabberCase& made, std::ostream* out) {
  *out << made.name;
}

class FrameGrabberContract : public testing::TestWithParam<GrabberCase> {
 protected:
  static constexpr CameraSet kAll = CameraSet::first(GrabberBench::kCameras);
  static constexpr Duration kPatience = std::chrono::milliseconds(50);

  const hal::FrameSet& grab(CameraSet delivering, CameraSet expected) {
    bench_->prepare(delivering);
    triggered_ = bench_->now();
    grabber_.trigger(triggered_);
    return grabber_.await(expected, triggered_ + kPatience);
  }

  std::unique_ptr<GrabberBench> bench_ = GetParam().make();
  hal::FrameGrabber& grabber_ = bench_->grabber();
  Time triggered_{};
};

}  // namespace dottrack::test
