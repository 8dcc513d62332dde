#pragma once
// How far a long command is: a bar on a terminal, nothing where standard error is a file.

#include <chrono>
#include <cstdint>
#include <string>

namespace dottrack::workstation {

class Progress {
 public:
  // `unit`: what is counted, as in "tick".
  Progress(std::string title, std::uint64_t total, std::string unit);
  // Clears the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::uint64_t done);
  // Counted units a second so far.
  double rate(std::uint64_t done) const;

 private:
  using Watch = std::chrono::steady_clock;

  double seconds() const;

  std::string title_;
  std::uint64_t total_;
  std::string unit_;
  bool on_terminal_;
  Watch::time_point start_ = Watch::now();
  Watch::time_point shown_;
};

}  // namespace dottrack::workstation
