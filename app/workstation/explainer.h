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

// Ticks with a pose are passed over. Ticks in a row for the same reason, with the same cameras, are
// told once, with the first one's numbers: "ticks 4 to 17: held_back still".
class Explainer final : public telemetry::RecordWriter {
 public:
  // `say` takes whole lines.
  Explainer(const config::RigConfig& config, std::function<void(const std::string&)> say);

  // To be called after the last record.
  void finish();

 private:
  void do_write(const telemetry::CycleRecord& record) override;
  std::string key_of(const core::TickResult& result) const;
  std::string about(const core::TickResult& result);
  std::string words(core::Reason reason);
  std::string camera_table(const core::TickResult& result) const;
  std::string camera_row(const std::string& name, const core::CameraTick& camera) const;
  std::string acquisition_lines(const core::TickResult& result) const;

  std::vector<std::string> cameras_;
  std::size_t dots_;
  double max_false_lock_probability_;
  std::function<void(const std::string&)> say_;
  std::uint32_t explained_ = 0;  // reasons, a bit each
  std::string last_;             // the key of the tick before; empty when that had a pose
  core::Reason last_reason_ = core::Reason::none;
  std::uint64_t same_from_ = 0;
  std::uint64_t same_ = 0;    // ticks from there on
  double least_false_ = 1.0;  // false-lock probability among them
};

}  // namespace dottrack::workstation
