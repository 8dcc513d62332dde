#pragma once
// What the loop asks of a motor and what the motor says of itself, between two threads, lock-free.

#include <atomic>
#include <cstdint>

#include "drivers/libgpiod/iris_motor.h"

namespace dottrack::drivers {

// One thread asks and one answers; any may look. Each way is one word, so nobody reads half of an
// old and half of a new one. An answer carries the number of the request that it answers.
class IrisMailbox {
 public:
  struct Status {
    int position_steps = 0;
    MotorPhase phase = MotorPhase::released;
  };
  struct View {
    MotorRequest request;
    Status status;
    bool answered = true;  // the status knows of the request
  };
  struct Numbered {
    MotorRequest request;
    std::uint16_t number = 0;
  };

  // By the thread that asks. Asking for the same again changes nothing.
  void ask(std::optional<int> target_steps) {
    const Numbered last = newest();
    if (last.request.target_steps == target_steps) return;
    const bool release = !target_steps;
    const auto releases = static_cast<std::uint16_t>(last.request.releases + (release ? 1 : 0));
    const auto number = static_cast<std::uint16_t>(last.number + 1);
    asked_.store(pack({{target_steps, releases}, number}), std::memory_order_release);
  }

  // By the thread that answers.
  Numbered newest() const { return unpack(asked_.load(std::memory_order_acquire)); }
  void answer(std::uint16_t number, const Status& status) {
    const auto position = static_cast<std::uint32_t>(status.position_steps);
    const auto phase = static_cast<std::uint64_t>(status.phase);
    answered_.store(std::uint64_t{position} | (std::uint64_t{number} << 32U) | (phase << 48U),
                    std::memory_order_release);
  }

  View view() const {
    const Numbered asked = newest();
    const std::uint64_t word = answered_.load(std::memory_order_acquire);
    const auto position = static_cast<std::int32_t>(word & 0xFFFF'FFFFU);
    const auto number = static_cast<std::uint16_t>(word >> 32U);
    return {
        asked.request, {position, static_cast<MotorPhase>(word >> 48U)}, number == asked.number};
  }

 private:
  static constexpr std::uint32_t kNoTarget = 0xFFFF'FFFFU;

  static std::uint64_t pack(const Numbered& asked) {
    const std::optional<int>& target = asked.request.target_steps;
    const std::uint32_t steps = target ? static_cast<std::uint32_t>(*target) : kNoTarget;
    return std::uint64_t{steps} | (std::uint64_t{asked.number} << 32U) |
           (std::uint64_t{asked.request.releases} << 48U);
  }

  static Numbered unpack(std::uint64_t word) {
    const auto steps = static_cast<std::uint32_t>(word & 0xFFFF'FFFFU);
    Numbered asked;
    if (steps != kNoTarget) asked.request.target_steps = static_cast<int>(steps);
    asked.request.releases = static_cast<std::uint16_t>(word >> 48U);
    asked.number = static_cast<std::uint16_t>((word >> 32U) & 0xFFFFU);
    return asked;
  }

  std::atomic<std::uint64_t> asked_{pack({})};
  std::atomic<std::uint64_t> answered_{0};
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace dottrack::drivers
