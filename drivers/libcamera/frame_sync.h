#pragma once
// Which frames make a tick: out of what the cameras sent, those that were exposed together.

#include <array>
#include <cstdint>
#include <optional>

#include "hal/base/camera_set.h"
#include "hal/base/static_vector.h"
#include "hal/base/time.h"

namespace dottrack::drivers {

// A frame that came in.
struct Arrival {
  Time mid_exposure{};
  std::uint32_t sequence = 0;
  std::uint8_t buffer = 0;  // the camera's own number of it
};

// Who gets the frames that no tick takes.
class LateFrames {
 public:
  virtual void give_back_late(std::size_t camera, const Arrival& frame) = 0;

 protected:
  ~LateFrames() = default;
};

// A group is a set of frames, at most one a camera, whose exposures lie within a quarter of a
// period of each other: one exposure of cameras that expose together.
//
// Triggered, a tick's frames are those exposed after its trigger. Free running, a tick takes the
// newest group that is complete; at its deadline the one with the most cameras, the newer of two
// equal ones. A group is left for the next tick when it is incomplete and a frame of it came only
// just now, so that a deadline amid the arrivals does not halve every set.
//
// Every frame that is added is either taken once or given back once, by the end of some later tick.
// Bounded work, no allocation, one thread.
class FrameSync {
 public:
  // Frames of one camera that may wait; of more, the oldest is given back.
  static constexpr std::size_t kMaxWaiting = 2;

  FrameSync(Duration period, bool triggered, LateFrames& late)
      : period_(period), triggered_(triggered), late_(late) {}

  // The tick begins, and with it the exposure when the cameras are triggered. Frames that are too
  // old for any tick from now on are given back.
  void begin(Time now);

  // `seen`: when the tick learned of it; never before that of an earlier frame.
  void add(std::size_t camera, const Arrival& frame, Time seen);

  // Whether there is nothing to wait for: a group of `expected` cameras that holds all of `wanted`.
  bool complete(CameraSet expected, CameraSet wanted) const;

  // Takes the tick's group and returns its cameras; perhaps none. What is older is given back.
  CameraSet take(CameraSet expected, CameraSet wanted, Time now);

  // Of a camera that the last take() returned.
  const Arrival& taken(std::size_t camera) const { return taken_[camera]; }

 private:
  struct Waiting {
    Arrival frame;
    Time seen{};
  };
  struct Group {
    Time first{};  // earliest exposure
    Time seen{};   // when the last of its frames came
    CameraSet cameras;
    std::array<std::uint8_t, kMaxCameras> at{};  // place in each camera's queue
  };

  bool is_past(const Arrival& frame) const;
  Group group_from(Time first, CameraSet expected) const;
  Group triggered_group(CameraSet expected) const;
  std::optional<Group> complete_group(CameraSet expected, CameraSet wanted) const;
  std::optional<Group> best_group(CameraSet expected, Time now) const;
  Time newest_exposure(CameraSet expected) const;
  template <class Reject>
  void give_back_if(std::size_t camera, Reject reject);

  Duration period_;
  bool triggered_;
  LateFrames& late_;
  std::array<StaticVector<Waiting, kMaxWaiting>, kMaxCameras> waiting_;
  std::array<Arrival, kMaxCameras> taken_{};
  Time earliest_ = Time::min();  // exposures before it belong to no tick any more
};

}  // namespace dottrack::drivers
