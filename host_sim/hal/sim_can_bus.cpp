#include "host_sim/hal/sim_can_bus.h"

#include <algorithm>
#include <cmath>

#include "app/core/protocol/receiver_frame.h"
#include "host_sim/world/random.h"

namespace dottrack::host_sim {
namespace {

// Of ISO 11898-1: what an error adds to the controller's count, and where its states begin.
constexpr int kErrorStep = 8;
constexpr int kWarning = 96;
constexpr int kPassive = 128;
constexpr int kBusOff = 256;
constexpr double kErrorFrame_bits = 23.0;  // flag, delimiter, interframe space

constexpr std::uint64_t kErrors = 0xCA4;

Time instant(double seconds) {
  return Time(Duration(std::llround(seconds * 1e9)));
}

}  // namespace

SimCanBus::SimCanBus(const CanModel& model, std::uint64_t seed, rtos::VirtualClock& clock,
                     hal::CanBus& log)
    : model_(model), seed_(seed), log_(log), clock_(clock) {
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = model.addressing.base_id;
  settings.extended = model.addressing.extended;
  dottrack_receiver_init(&receiver_, &settings);
  busy_until_ = settled_ = off_until_ = clock.now();
  std::sort(model_.bus_off.begin(), model_.bus_off.end(),
            [](const CanOutage& a, const CanOutage& b) { return a.from_s < b.from_s; });
}

SimCanBus::LineBits SimCanBus::bits(const hal::CanFrame& frame) {
  const double data = 8.0 * frame.length;
  constexpr double kEnd = 13.0;  // checksum delimiter, acknowledge, end, interframe space
  if (!frame.fd) {
    const double stuffed = (frame.extended ? 54.0 : 34.0) + data;  // start of frame to checksum
    return {stuffed + std::floor((stuffed - 1.0) / 4.0) + kEnd, 0.0};
  }
  const double head = frame.extended ? 36.0 : 17.0;  // start of frame to bit rate switch
  const double stuffed = head + 5.0 + data;          // error state, length, data
  const double stuff_of_head = std::floor((head - 1.0) / 4.0);
  const double stuff = std::floor((stuffed - 1.0) / 4.0);
  // Stuff count, checksum and their fixed stuff bits.
  const double checksum = frame.length <= 16 ? 4.0 + 17.0 + 6.0 : 4.0 + 21.0 + 7.0;
  const LineBits bits{head + stuff_of_head + kEnd,
                      stuffed - head + stuff - stuff_of_head + checksum};
  return frame.bit_rate_switch ? bits : LineBits{bits.arbitration + bits.data, 0.0};
}

// Others use their share of the bus, so a frame takes longer by that.
Duration SimCanBus::bit_times(const LineBits& bits) const {
  const double free_share = std::max(1.0 - model_.load, 1e-3);
  const double seconds = bits.arbitration / model_.bit_rate + bits.data / model_.data_bit_rate;
  return Duration(std::llround(seconds / free_share * 1e9));
}

bool SimCanBus::off(Time at) const {
  if (at < off_until_) return true;
  const Duration recovery = bit_times(kRecovery);
  return std::any_of(model_.bus_off.begin(), model_.bus_off.end(), [&](const CanOutage& outage) {
    return instant(outage.from_s) <= at && at < instant(outage.to_s) + recovery;
  });
}

// Everything up to `now`, in order: what goes out, and what an outage takes away.
void SimCanBus::settle(Time now) {
  for (const CanOutage& outage : model_.bus_off) {
    const Time from = instant(outage.from_s);
    if (from <= settled_ || from > now) continue;
    send_until(from);
    go_off(from, instant(outage.to_s) + bit_times(kRecovery));
  }
  send_until(now);
  settled_ = std::max(settled_, now);
}

void SimCanBus::send_until(Time now) {
  while (waiting_ > 0 && queue_[first_].done <= now) {
    on_the_line(queue_[first_]);
    first_ = (first_ + 1) % kQueue;
    --waiting_;
  }
}

void SimCanBus::go_off(Time from, Time until) {
  counts_.lost += waiting_;
  waiting_ = 0;
  busy_until_ = from;
  off_until_ = std::max(off_until_, until);
  error_count_ = 0;
}

void SimCanBus::on_the_line(const Waiting& waiting) {
  ++counts_.sent;
  const dottrack_frame frame = protocol::to_receiver(waiting.frame);
  const auto arrival =
      std::chrono::floor<std::chrono::microseconds>(waiting.done.time_since_epoch());
  dottrack_pose pose{};
  if (dottrack_receiver_push(&receiver_, &frame, static_cast<std::uint64_t>(arrival.count()),
                             &pose) == DOTTRACK_FRESH) {
    ++counts_.groups;
    last_pose_ = pose;
  }
}

// When a frame that starts at an instant is through, errors and repetitions included. Errors may
// take the bus off before it is.
Time SimCanBus::transmit(const hal::CanFrame& frame, Time start) {
  Time end = start;
  while (unit_interval(mix(mix(seed_, kErrors), attempts_++)) < model_.error_share) {
    ++counts_.destroyed;
    end += bit_times(bits(frame)) / 2 + bit_times({kErrorFrame_bits, 0.0});
    error_count_ += kErrorStep;
    if (error_count_ >= kBusOff) return end;
  }
  error_count_ = std::max(0, error_count_ - 1);
  return end + bit_times(bits(frame));
}

hal::SendResult SimCanBus::do_send(const hal::CanFrame& frame, Time deadline) {
  settle(clock_.now());
  if (!off(clock_.now()) && waiting_ == kQueue) {
    const Time room = queue_[first_].done;
    clock_.jump_to(std::min(room, deadline));
    settle(clock_.now());
  }
  if (off(clock_.now())) {
    ++counts_.refused_off;
    return hal::SendResult::failed;
  }
  if (waiting_ == kQueue) {
    ++counts_.refused_full;
    return hal::SendResult::try_again;
  }
  const hal::SendResult logged = log_.send(frame, deadline);
  if (logged != hal::SendResult::accepted) return logged;
  ++counts_.accepted;
  busy_until_ = transmit(frame, std::max(busy_until_, clock_.now()));
  queue_[(first_ + waiting_) % kQueue] = {frame, busy_until_};
  ++waiting_;
  if (error_count_ >= kBusOff) {
    ++counts_.bus_offs;
    go_off(busy_until_, busy_until_ + bit_times(kRecovery));
  }
  return hal::SendResult::accepted;
}

bool SimCanBus::do_receive(hal::CanFrame& frame) {
  if (inbox_waiting_ == 0) return false;
  frame = inbox_[inbox_first_];
  inbox_first_ = (inbox_first_ + 1) % inbox_.size();
  --inbox_waiting_;
  return true;
}

hal::CanState SimCanBus::do_state() const {
  if (off(clock_.now())) return hal::CanState::bus_off;
  if (error_count_ >= kPassive) return hal::CanState::passive;
  return error_count_ >= kWarning ? hal::CanState::warning : hal::CanState::active;
}

bool SimCanBus::inject(const hal::CanFrame& frame) {
  if (inbox_waiting_ == inbox_.size()) return false;
  inbox_[(inbox_first_ + inbox_waiting_) % inbox_.size()] = frame;
  ++inbox_waiting_;
  return true;
}

const CanCounts& SimCanBus::counts() {
  settle(clock_.now());
  return counts_;
}

const std::optional<dottrack_pose>& SimCanBus::last_pose() {
  settle(clock_.now());
  return last_pose_;
}

}  // namespace dottrack::host_sim
