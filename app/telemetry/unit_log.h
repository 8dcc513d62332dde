#pragma once
// What a person who looks after a unit wants to read: what changed, and how things stand.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/telemetry/recorder.h"

namespace dottrack::telemetry {

enum class Severity : std::uint8_t { error = 3, warning = 4, info = 6 };  // as syslog counts them

using LogLine = std::function<void(Severity, const std::string&)>;

// Tells of changes only: a lock found or lost, a camera that stays away or is back, frames that do
// not go out, ticks that were missed. Outside the loop; fed from its records.
class UnitLog final : public RecordWriter {
 public:
  // A camera counts as away after so many ticks without an image: one lost frame is no news.
  static constexpr std::uint32_t kTicksAway = 3;

  UnitLog(std::vector<std::string> cameras, LogLine log);

  // "tracking, 11 of 12 cameras (without cam5), 12345 ticks, 3 missed"
  std::string status() const;

 private:
  void do_write(const CycleRecord& record) override;
  void note_state(const core::TickResult& result);
  void note_cameras(const core::TickResult& result);
  void note_moved(const core::TickResult& result);
  void note_can(const CycleCounters& counters);
  void note_can_state(hal::CanState state);
  void note_irises(CameraSet unhealthy);
  void note_losses(const CycleCounters& counters);
  void note_commands(const protocol::CommandCounts& commands);
  std::string names_of(CameraSet cameras) const;

  std::vector<std::string> cameras_;
  LogLine log_;
  std::uint64_t ticks_ = 0;
  core::State state_ = core::State::acquiring;
  core::Reason reason_ = core::Reason::no_frames;
  std::array<std::uint32_t, kMaxCameras> ticks_away_{};
  CameraSet away_;
  CameraSet moved_;
  std::array<float, kMaxCameras> shift_px_{};  // before it was left out
  bool rig_disagrees_ = false;
  CameraSet unhealthy_irises_;
  hal::CanState can_state_ = hal::CanState::active;
  bool can_silent_ = false;
  std::uint64_t unsent_at_silence_ = 0;
  CycleCounters counters_;
  std::uint64_t ticks_of_last_loss_ = 0;
  CycleCounters told_;
  protocol::CommandCounts told_commands_;
  std::uint64_t ticks_of_last_command_ = 0;
};

}  // namespace dottrack::telemetry
