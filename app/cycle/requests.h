#pragma once
// What commands over CAN ask for that is not the loop's to do.

#include <atomic>
#include <cstdint>
#include <optional>

namespace dottrack::cycle {

// The loop asks, another thread comes for it. Of several wishes the last one counts.
class Requests {
 public:
  void ask_for_target(std::uint8_t target) { target_.store(target); }
  std::optional<std::uint8_t> take_target() {
    const int target = target_.exchange(kNone);
    if (target == kNone) return std::nullopt;
    return static_cast<std::uint8_t>(target);
  }
  bool pending() const { return target_.load() != kNone; }

 private:
  static constexpr int kNone = -1;
  std::atomic<int> target_{kNone};
};

}  // namespace dottrack::cycle
