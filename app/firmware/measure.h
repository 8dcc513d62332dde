#pragma once
// How punctual a unit is: wake-up latency, time a stage, age of a pose at its CAN frame.

#include <string>
#include <vector>

#include "app/telemetry/recorder.h"

namespace dottrack::firmware {

class Measure final : public telemetry::RecordWriter {
 public:
  // A table of percentiles and histograms, for a terminal.
  std::string report(std::uint64_t heap_calls) const;

 private:
  void do_write(const telemetry::CycleRecord& record) override;

  struct Quantity {
    const char* name;
    std::vector<double> us = {};
  };
  static std::string row(const Quantity& quantity);
  static std::string histogram(const Quantity& quantity);

  Quantity wake_{"wake-up latency"};
  Quantity capture_{"capture"};
  Quantity track_{"track"};
  Quantity broadcast_{"broadcast"};
  Quantity expose_{"expose"};
  Quantity record_{"record"};
  Quantity cycle_{"whole tick"};
  Quantity age_{"age of a pose at its CAN frame"};
  telemetry::CycleCounters counters_;
};

}  // namespace dottrack::firmware
