#pragma once
// How well a run's light was kept: figures of its records.

#include <cstdint>
#include <string>
#include <vector>

#include "app/telemetry/recorder.h"

namespace dottrack::workstation {

struct LightFigures {
  std::uint64_t ticks = 0;
  std::uint64_t without_pose = 0;  // after the first lock
  std::uint64_t longest_gap = 0;   // ticks without a pose, one after another
  std::uint64_t bloomed_views = 0;
  std::uint64_t saturated = 0;  // pictures of cameras with saturated pixels in the dots
  double position_rms_mm = 0.0;
  // From a change of the light (its end where it is faded) until no camera has saturated dots and
  // all but one in eight have dots as bright as they should be; the longest. -1: one never did.
  double settled_after_s = 0.0;
  std::vector<std::string> faults;  // "cam5 at 6.2 s"
};

// What a tally has to know of a run.
struct LightScript {
  std::vector<std::string> cameras;  // their names
  double frame_rate_hz = 10.0;
  std::vector<double> changes_s;  // instants after the start from which on the light should settle
};

// Takes the records of a run, tick by tick.
class LightTally final : public telemetry::RecordWriter {
 public:
  explicit LightTally(LightScript script);

  // All but the position's error, for which records are not enough.
  LightFigures figures() const;

 private:
  void do_write(const telemetry::CycleRecord& record) override;
  void count_cameras(const telemetry::CycleRecord& record);
  void note_faults(const telemetry::CycleRecord& record);
  std::size_t tick_of(double time_s) const;
  double settled_after_s() const;

  LightScript script_;
  std::vector<bool> settled_;  // tick by tick
  LightFigures figures_;
  bool locked_ = false;
  std::uint64_t gap_ = 0;
  CameraSet named_;
};

}  // namespace dottrack::workstation
