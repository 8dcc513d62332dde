// A pose onto the bus and off it again. One iteration is one whole group.

#include <benchmark/benchmark.h>

#include <cstring>

#include "app/core/protocol/pose_encoder.h"
#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::bench {
namespace {

using namespace protocol;

// A vehicle that drives, with all 21 terms of a covariance.
PoseMessage driving() {
  Eigen::Matrix<double, 6, 6> root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = 0.001 * ((7 * i) % 11 - 5);
  PoseMessage message;
  message.state = core::State::tracking;
  message.reason = core::Reason::none;
  message.pose_valid = true;
  message.position_m = {1.23, -4.56, 0.78};
  message.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  message.residual_m = 0.0012;
  message.false_lock_probability = 1e-9;
  message.covariance = root * root.transpose() + 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
  message.velocity_m_s = Eigen::Vector3d(1.0, 0.2, 0.0);
  message.rates_rad_s = Eigen::Vector3d(0.0, 0.01, 0.3);
  message.age = std::chrono::milliseconds(12);
  return message;
}

constexpr GroupParts kPoseAndAll{
    .covariance = true, .motion = true, .cameras = false, .dots = false};

void drive_on(PoseMessage& message) {
  message.position_m.x() = message.position_m.x() > 100.0 ? -100.0 : message.position_m.x() + 0.001;
  message.mid_exposure += std::chrono::milliseconds(33);
}

class Sender {
 public:
  explicit Sender(bool fd) : addressing_{.base_id = kDefaultBaseId, .extended = false, .fd = fd} {}

  const GroupFrames& send() {
    drive_on(message_);
    encode_group(message_, kPoseAndAll, addressing_, sequence_++, frames_);
    return frames_;
  }

 private:
  PoseMessage message_ = driving();
  Addressing addressing_;
  std::uint8_t sequence_ = 0;
  GroupFrames frames_;
};

class Vehicle {
 public:
  Vehicle() {
    const dottrack_settings settings = dottrack_default_settings();
    dottrack_receiver_init(&receiver_, &settings);
  }

  // Whether the group ends in a fresh pose with all that belongs to it.
  bool hear(const GroupFrames& frames) {
    now_us_ += 33'000;
    dottrack_verdict verdict = DOTTRACK_FOREIGN;
    for (const hal::CanFrame& frame : frames) {
      given_.id = frame.id;
      given_.extended = frame.extended;
      given_.length = frame.length;
      std::memcpy(given_.data, frame.data.data(), sizeof given_.data);
      verdict = dottrack_receiver_push(&receiver_, &given_, now_us_, &pose_);
    }
    return verdict == DOTTRACK_FRESH && pose_.valid && pose_.has_covariance && pose_.has_rates;
  }

 private:
  dottrack_receiver receiver_{};
  dottrack_frame given_{};
  dottrack_pose pose_{};
  std::uint64_t now_us_ = 1'000'000;
};

// Over more groups than the sequence has numbers, outside the time that is measured.
template <class Group>
void require_no_heap(benchmark::State& state, Group group) {
  const rtos::AllocationTrap::Scope trap;
  for (int i = 0; i < 300; ++i) group();
  const auto calls = static_cast<double>(trap.calls().total());
  state.counters["heap_calls"] = calls;
  if (calls > 0.0) state.SkipWithError("a group took memory from the heap");
}

void encode(benchmark::State& state, bool fd) {
  Sender sender(fd);
  std::size_t frames = 0;
  require_no_heap(state, [&] { frames = sender.send().size(); });
  for (auto _ : state) {
    benchmark::DoNotOptimize(sender.send().data());
    benchmark::ClobberMemory();
  }
  state.counters["frames"] = static_cast<double>(frames);
}

void encode_and_decode(benchmark::State& state, bool fd) {
  Sender sender(fd);
  Vehicle vehicle;
  bool fresh = true;
  require_no_heap(state, [&] { fresh = vehicle.hear(sender.send()) && fresh; });
  for (auto _ : state) fresh = vehicle.hear(sender.send()) && fresh;
  if (!fresh) state.SkipWithError("a group did not come through");
}

BENCHMARK_CAPTURE(encode, classic, false)->Name("pose_group/encode/classic");
BENCHMARK_CAPTURE(encode, fd, true)->Name("pose_group/encode/fd");
BENCHMARK_CAPTURE(encode_and_decode, classic, false)->Name("pose_group/encode_decode/classic");
BENCHMARK_CAPTURE(encode_and_decode, fd, true)->Name("pose_group/encode_decode/fd");

}  // namespace
}  // namespace dottrack::bench
