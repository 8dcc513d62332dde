#pragma once
// One line of a GPIO chip as an output.

#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/output_line.h"

namespace dottrack::drivers {

class LineBanks;

struct GpioLine {
  std::string chip;  // label, name or path of a chip
  unsigned offset = 0;
  bool active_low = false;
};

// Inactive from the start and again after its end.
class GpioOutputLine final : public hal::OutputLine {
 public:
  // `consumer` is what gpioinfo shows. An error names chip, line and reason.
  static Result<std::unique_ptr<GpioOutputLine>> open(const GpioLine& line,
                                                      const std::string& consumer);
  // The same over other banks than the kernel's.
  static Result<std::unique_ptr<GpioOutputLine>> open(const GpioLine& line,
                                                      const std::string& consumer,
                                                      LineBanks& banks);
  ~GpioOutputLine() override;

 private:
  class Request;
  explicit GpioOutputLine(std::unique_ptr<Request> request);
  bool do_set(bool active) override;

  std::unique_ptr<Request> request_;
};

struct GpioChip {
  std::string path;   // /dev/gpiochip0
  std::string label;  // as the kernel names it
  unsigned lines = 0;
};

// Every GPIO chip of the machine, by path. Start-up only.
std::vector<GpioChip> list_gpio_chips();

}  // namespace dottrack::drivers
