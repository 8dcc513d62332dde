#pragma once
// For people at a terminal: the newest pose and how well poses come, redrawn in place.

#include <cstdio>
#include <string>
#include <vector>

#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

// One line a fact, none longer than a narrow terminal; without line ends.
struct TableContent {
  std::string title;
  std::string notice;
  std::string verdict;
  bool has_pose = false;
  dottrack_pose pose{};     // of the newest whole group
  dottrack_pose cameras{};  // of the newest one with the cameras' health
};
std::vector<std::string> table_lines(const TableContent& content, const Overview& overview,
                                     Duration now);

class LiveTable final : public Writer {
 public:
  LiveTable(std::FILE* out, std::string title);

 private:
  void do_report(const Report& report, const Overview& overview) override;
  void do_pause(Duration now, const Overview& overview) override;
  void do_notice(const std::string& line) override;
  Result<void> do_finish(const Overview& overview) override;
  void draw(Duration now, const Overview& overview);

  std::FILE* out_;
  TableContent content_;
  std::size_t drawn_lines_ = 0;
  Duration drawn_at_{};
  Duration now_{};
};

}  // namespace dottrack::monitor
