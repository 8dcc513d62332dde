#pragma once
// Why a pose is worth less than it could be. The numbers are bits of the signal Degraded: they
// never change meaning.

#include <cstdint>
#include <string_view>

namespace dottrack::protocol {

enum class Degraded : std::uint8_t {
  camera_missing = 0,       // a camera of the rig delivered nothing in this tick
  camera_stale = 1,         // ... or the picture of the tick before again
  camera_overflow = 2,      // ... or more regions than there is room for
  iris_fault = 3,           // an iris does not answer
  dots_missing = 4,         // the pose rests on fewer dots than the target has
  single_view_dots = 5,     // a dot counts that one camera alone sees
  tick_missed = 6,          // instants went by unattended since the last message
  bus_trouble = 7,          // the CAN controller counts errors
  message_lost = 8,         // the message before this one did not go out whole
  record_lost = 9,          // the recorder was too slow
  not_real_time = 10,       // the unit runs without what it asked the machine for
  covariance_unknown = 11,  // there is a pose, but its covariance does not fit into the messages
  few_cameras = 12,         // the pose rests on two cameras only
  camera_moved = 13,        // a camera stands no longer as its model says, and is left out
  rig_disagrees = 14,       // more cameras contradict each other than can be left out
};

inline constexpr unsigned kDegradedReasons = 15;

class DegradedSet {
 public:
  constexpr DegradedSet() = default;
  constexpr explicit DegradedSet(std::uint16_t bits) : bits_(bits) {}

  constexpr void insert(Degraded reason) {
    bits_ = static_cast<std::uint16_t>(bits_ | bit(reason));
  }
  constexpr void insert_if(bool holds, Degraded reason) {
    if (holds) insert(reason);
  }
  constexpr bool contains(Degraded reason) const { return (bits_ & bit(reason)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint16_t bits() const { return bits_; }
  constexpr bool operator==(const DegradedSet&) const = default;

 private:
  static constexpr std::uint16_t bit(Degraded reason) {
    return static_cast<std::uint16_t>(1U << static_cast<unsigned>(reason));
  }

  std::uint16_t bits_ = 0;
};

// One word each: "camera_missing".
std::string_view to_string(Degraded reason);

}  // namespace dottrack::protocol
