#pragma once
// What befalls the source, for people, where no table shows it.

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

class NoticeLines final : public Writer {
 private:
  void do_notice(const std::string& line) override { fmt::print(stderr, "dottrack: {}\n", line); }
};

}  // namespace dottrack::monitor
