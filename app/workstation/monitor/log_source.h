#pragma once
// The frames of a candump log.

#include <cstdint>
#include <istream>
#include <string>

#include "app/workstation/monitor/frame_source.h"

namespace dottrack::monitor {

class LogSource final : public FrameSource {
 public:
  // `interface` empty: that of the first frame. The stream outlives the source.
  LogSource(std::istream& log, std::string interface);

  std::uint64_t frames() const { return frames_; }  // of every interface
  std::uint64_t unreadable_lines() const { return unreadable_lines_; }

 private:
  Got do_next(Arrival& arrival) override;
  bool take(const std::string& line, Arrival& arrival);

  std::istream& log_;
  std::string interface_;
  std::string line_;
  Duration latest_ = Duration::min();
  std::uint64_t frames_ = 0;
  std::uint64_t unreadable_lines_ = 0;
};

}  // namespace dottrack::monitor
