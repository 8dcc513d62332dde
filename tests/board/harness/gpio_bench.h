#pragma once
// What hangs on the board's GPIO lines: the irises, the trigger, the lamp.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "tests/board/harness/gpio_trace.h"
#include "tests/board/harness/iris_mechanics.h"

namespace dottrack::board {

// From any thread. Fed with the lines of the guest's trace.
class GpioBench {
 public:
  explicit GpioBench(std::size_t cameras);

  void take(std::string_view trace_line);
  // The board was reset: its lines are low again; counts begin at 0. Irises stay where they are.
  void start_boot();

  IrisMechanics iris(std::size_t camera) const;
  std::vector<Time> trigger_pulses() const;  // rising edges, on the guest's monotonic clock
  std::uint64_t lamp_changes() const;
  bool complete() const;  // the trace lost nothing

 private:
  void apply(const GpioWrite& write);
  void apply_to_iris(unsigned line, bool high);

  mutable std::mutex mutex_;
  std::optional<unsigned> base_;
  std::vector<GpioWrite> pending_;  // written before the guest told the chip's base
  std::vector<IrisMechanics> irises_;
  std::vector<Time> pulses_;
  bool trigger_ = false;
  bool lamp_ = false;
  std::uint64_t lamp_changes_ = 0;
  bool complete_ = true;
};

}  // namespace dottrack::board
