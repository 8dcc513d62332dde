#pragma once
// One JSON object a line: every group, everything that is wrong with one, and at the end the sum.

#include <cstdio>
#include <string>

#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

// Without a line's end. What is not known is null.
std::string report_object(const Report& report);
std::string summary_object(const Overview& overview);

class JsonLines final : public Writer {
 public:
  explicit JsonLines(std::FILE* out) : out_(out) {}

 private:
  void do_report(const Report& report, const Overview& overview) override;
  Result<void> do_finish(const Overview& overview) override;

  std::FILE* out_;
};

}  // namespace dottrack::monitor
