#pragma once
// Why there is no lock, for a person: every tick without a pose with its reason, what can be done
// about it, and what became of each camera's regions gate by gate.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/config/rig_file.h"
#include "app/telemetry/recorder.h"

namespace dottrack::workstation {

// Ticks with a pose are passed over. A tick that says the same as the one before it is only
// counted: "ticks 4 to 17: the same".
class Explainer final : public telemetry::RecordWriter {
 public:
  // `say` takes whole lines.
  Explainer(const config::RigConfig& config, std::function<void(const std::string&)> say);

  // To be called after the last record.
  void finish();

 private:
  void do_write(const telemetry::CycleRecord& record) override;
  std::string about(const telemetry::CycleRecord& record) const;
  std::string camera_table(const core::TickResult& result) const;
  std::string camera_row(const std::string& name, const core::CameraTick& camera) const;
  std::string acquisition_lines(const core::TickResult& result) const;

  std::vector<std::string> cameras_;
  std::size_t dots_;
  double max_false_lock_probability_;
  std::function<void(const std::string&)> say_;
  std::string last_;  // about the tick before; empty when that had a pose
  std::uint64_t same_from_ = 0;
  std::uint64_t same_ = 0;  // ticks from there on
};

}  // namespace dottrack::workstation
