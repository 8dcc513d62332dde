#pragma once
// P-irises on GPIO lines: step, direction, enable, auto-iris override, end stop.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/iris.h"
#include "rtos_shim/clock.h"

namespace dottrack::drivers {

class LineBanks;

struct IrisWiring {
  std::string name;  // of the camera, for messages and consumers
  std::string chip;  // label, name or path
  unsigned step_line = 0;
  unsigned direction_line = 0;  // active: opens
  std::optional<unsigned> enable_line;
  std::optional<unsigned> auto_line;      // active: overrides the lens's auto-iris
  std::optional<unsigned> end_stop_line;  // input, active at the closed end
  int travel_steps = 0;                   // from closed to fully open
  double steps_per_s = 100.0;
  int backlash_steps = 0;
  std::array<double, 2> limits{0.0, 1.0};  // openings it may be sent to
};

// Requests come from the loop and are lock-free; the steps are made by advance(), which a thread of
// its own calls at every step_period(). An iris homes against its closed end before its first
// movement, and again when its auto-iris was in charge in between. One whose end stop contradicts
// its position, or whose lines cannot be driven, stands still and is unhealthy until it is given
// back to its auto-iris. Nothing allocates after open().
class GpioIris final : public hal::Iris {
 public:
  // One entry a camera; a camera without an iris has none. An error names camera, chip, line.
  static Result<std::unique_ptr<GpioIris>> open(std::vector<std::optional<IrisWiring>> irises,
                                                const rtos::Clock& clock);
  // The same over other banks than the kernel's.
  static Result<std::unique_ptr<GpioIris>> open(std::vector<std::optional<IrisWiring>> irises,
                                                const rtos::Clock& clock, LineBanks& banks);
  // Gives every lens back to its auto-iris and takes the current off the motors.
  ~GpioIris() override;

  // Half the time between two steps of the fastest iris and a fiftieth more, so that a wake-up a
  // little early misses no step: how often advance() is due.
  Duration step_period() const;
  // By one thread. Reads each chip's inputs and writes its outputs with one call each, and only
  // where there is something to do. A late call makes the irises slower, never faster.
  void advance(Time now);

  // Steps made so far, homing included; from any thread.
  std::uint64_t steps(std::size_t camera) const;

 private:
  class Motors;
  explicit GpioIris(std::unique_ptr<Motors> motors);
  bool do_move_to(std::size_t camera, double opening) override;
  bool do_release_to_auto(std::size_t camera) override;
  hal::IrisState do_state(std::size_t camera) const override;

  std::unique_ptr<Motors> motors_;
};

}  // namespace dottrack::drivers
