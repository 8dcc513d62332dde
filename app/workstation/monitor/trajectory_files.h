#pragma once
// The fresh valid poses as files for trajectory tools. Stamps are the middle of the exposure on the
// unit's clock.

#include <string>
#include <string_view>
#include <utility>

#include "app/telemetry/output_file.h"
#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

// poses.tum as `dottrack replay` writes it: t x y z qx qy qz qw.
class TumFile final : public Writer {
 public:
  explicit TumFile(telemetry::OutputFile file) : file_(std::move(file)) {}

 private:
  void do_report(const Report& report, const Overview& overview) override;
  Result<void> do_finish(const Overview&) override { return file_.finish(); }

  telemetry::OutputFile file_;
};

// The columns of the EuRoC data sets first, so that `evo_traj euroc` reads it; what is not known is
// nan. All of it numbers but the header, which begins with #.
std::string_view csv_header();
std::string csv_line(const dottrack_pose& pose);

class CsvFile final : public Writer {
 public:
  explicit CsvFile(telemetry::OutputFile file);

 private:
  void do_report(const Report& report, const Overview& overview) override;
  Result<void> do_finish(const Overview&) override { return file_.finish(); }

  telemetry::OutputFile file_;
};

}  // namespace dottrack::monitor
