#pragma once
// The C receiver, with what it promises checked after every call.

#include <array>
#include <cstdint>
#include <optional>

#include "app/core/protocol/receiver/dottrack_receiver.h"

namespace dottrack::fuzz {

class CheckedReceiver {
 public:
  explicit CheckedReceiver(const dottrack_settings& settings);

  void push(const dottrack_frame& frame);
  void poll();
  void wait(std::uint64_t duration_us);  // the clock never goes back, and stops at its end

  std::uint64_t now_us() const { return now_us_; }
  const dottrack_settings& settings() const { return receiver_.settings; }
  // How often each verdict was given to a frame.
  std::uint64_t given(dottrack_verdict verdict) const;

 private:
  static constexpr std::size_t kVerdicts = DOTTRACK_OTHER_VERSION + 1;

  void check_frame(const dottrack_frame& frame, dottrack_verdict verdict) const;
  void check_repetition(const dottrack_frame& frame, dottrack_verdict verdict) const;
  void check_counts(const dottrack_counts& before, dottrack_verdict verdict) const;
  using Lights = std::array<dottrack_light, DOTTRACK_MAX_CAMERAS>;
  void check_lights(const Lights& before, const dottrack_frame& frame,
                    dottrack_verdict verdict) const;
  void check_totals() const;
  void check_pose(const dottrack_pose& pose, dottrack_verdict verdict);
  void check_order(const dottrack_pose& pose);

  dottrack_receiver receiver_{};
  std::uint64_t now_us_ = 0;
  std::array<std::uint64_t, kVerdicts> given_{};
  std::optional<dottrack_frame> last_;  // pushed at this very time
  bool had_fresh_ = false;
  std::uint64_t last_capture_us_ = 0;
};

}  // namespace dottrack::fuzz
