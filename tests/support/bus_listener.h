#pragma once
// A vehicle's ear: CAN frames in, what its receiver made of them out.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/core/protocol/addressing.h"
#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "app/core/protocol/receiver_frame.h"
#include "hal/base/can_frame.h"

namespace dottrack::test {

class BusListener {
 public:
  explicit BusListener(const protocol::Addressing& addressing = {}) {
    dottrack_settings settings = dottrack_default_settings();
    settings.base_id = addressing.base_id;
    settings.extended = addressing.extended;
    dottrack_receiver_init(&receiver_, &settings);
  }

  // Frames come a tenth of a millisecond apart.
  dottrack_verdict hear(const hal::CanFrame& frame) {
    const dottrack_frame given = protocol::to_receiver(frame);
    now_us_ += 100;
    dottrack_pose pose{};
    const dottrack_verdict verdict = dottrack_receiver_push(&receiver_, &given, now_us_, &pose);
    if (verdict == DOTTRACK_FRESH) poses_.push_back(pose);
    return verdict;
  }
  void wait_us(std::uint64_t us) { now_us_ += us; }

  const std::vector<dottrack_pose>& poses() const { return poses_; }  // of fresh groups
  const dottrack_counts& counts() const { return receiver_.counts; }
  const dottrack_unit& unit() const { return receiver_.unit; }
  const dottrack_light& light(std::size_t camera) const { return receiver_.light[camera]; }

 private:
  dottrack_receiver receiver_{};
  std::uint64_t now_us_ = 1'000'000;
  std::vector<dottrack_pose> poses_;
};

}  // namespace dottrack::test
