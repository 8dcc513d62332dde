#pragma once
// For people: one line a group, and the statistics at the end.

#include <cstdio>
#include <string>

#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

// Without a line's end.
std::string report_line(const Report& report);

// Several lines, each with its end.
std::string statistics_text(const Overview& overview);

class TextLines final : public Writer {
 public:
  explicit TextLines(std::FILE* out) : out_(out) {}

 private:
  void do_report(const Report& report, const Overview& overview) override;
  Result<void> do_finish(const Overview& overview) override;

  std::FILE* out_;
};

}  // namespace dottrack::monitor
