#include "app/workstation/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace dottrack::workstation {
namespace {

constexpr int kBarLength = 30;
constexpr std::chrono::milliseconds kBetween{100};

}  // namespace

Progress::Progress(std::string title, std::uint64_t total, std::string unit)
    : title_(std::move(title)),
      total_(std::max<std::uint64_t>(total, 1)),
      unit_(std::move(unit)),
      on_terminal_(isatty(STDERR_FILENO) != 0) {
  show(0);
}

Progress::~Progress() {
  if (on_terminal_) std::fputs("\r\x1b[K", stderr);
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Watch::now() - start_).count();
}

double Progress::rate(std::uint64_t done) const {
  return static_cast<double>(done) / std::max(seconds(), 1e-9);
}

void Progress::show(std::uint64_t done) {
  if (!on_terminal_ || (done < total_ && Watch::now() - shown_ < kBetween)) return;
  shown_ = Watch::now();
  const double share = static_cast<double>(done) / static_cast<double>(total_);
  const int full = static_cast<int>(share * kBarLength);
  const std::string left = done == 0 ? std::string("...")
                                     : fmt::format("{:.1f} {}s/s, {:.0f} s left", rate(done), unit_,
                                                   static_cast<double>(total_ - done) / rate(done));
  fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {:3.0f} % {}", title_, "", full, "",
             kBarLength - full, 100.0 * share, left);
  std::fflush(stderr);
}

}  // namespace dottrack::workstation
