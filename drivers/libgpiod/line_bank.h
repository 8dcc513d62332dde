#pragma once
// The one seam over libgpiod: a set of lines of one chip, written and read together. Two files
// implement it, one a major version of the library; a test has banks in memory.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/libgpiod/gpio_output_line.h"
#include "hal/base/result.h"

namespace dottrack::drivers {

inline constexpr std::size_t kMaxBankLines = 64;  // of outputs, and of inputs: one bit each

struct BankLine {
  unsigned offset = 0;
  bool active_low = false;
  bool active = false;  // an output's value from the start
  std::string purpose;  // for messages: "cam1: step"
};

struct BankRequest {
  GpioChip chip;
  std::string consumer;  // what gpioinfo shows
  std::vector<BankLine> outputs;
  std::vector<BankLine> inputs;  // their bias stays as it is
};

// Lines that belong to this process until the bank ends. Bit i is line i of the request; 1 is
// active. Nothing allocates after construction. A released output keeps its value or not as its
// chip pleases, so what has to be inactive is set so before.
class LineBank {
 public:
  LineBank() = default;
  LineBank(const LineBank&) = delete;
  LineBank& operator=(const LineBank&) = delete;
  virtual ~LineBank() = default;

  // Sets the outputs in `mask` in one call to the kernel; false when they cannot be driven.
  bool set(std::uint64_t mask, std::uint64_t values) { return do_set(mask, values); }
  // All inputs at one instant; nothing when they cannot be read.
  std::optional<std::uint64_t> inputs() { return do_inputs(); }

 private:
  virtual bool do_set(std::uint64_t mask, std::uint64_t values) = 0;
  virtual std::optional<std::uint64_t> do_inputs() = 0;
};

// Where banks come from: the kernel, or a test.
class LineBanks {
 public:
  LineBanks() = default;
  LineBanks(const LineBanks&) = delete;
  LineBanks& operator=(const LineBanks&) = delete;
  virtual ~LineBanks() = default;

  // The one chip that goes by this label, name or path.
  Result<GpioChip> find(const std::string& chip) { return do_find(chip); }
  // An error names purpose, line and chip.
  Result<std::unique_ptr<LineBank>> request(const BankRequest& lines) { return do_request(lines); }

 private:
  virtual Result<GpioChip> do_find(const std::string& chip) = 0;
  virtual Result<std::unique_ptr<LineBank>> do_request(const BankRequest& lines) = 0;
};

LineBanks& kernel_line_banks();

// "cam1: step line 5 of GPIO chip iris-steppers (/dev/gpiochip0)", to begin a message with.
std::string line_name(const BankRequest& lines, const BankLine& line);

// Who has a line already, by offset; nothing for a free one.
using LineUser = std::function<std::optional<std::string>(unsigned offset)>;

// Refuses a line that the chip does not have, that is asked for twice or that somebody else uses.
Result<void> check_lines(const BankRequest& lines, const LineUser& user);

// What each version of the library implements. Start-up only.
namespace gpiod {
Result<GpioChip> read_chip(const std::string& path);
Result<std::unique_ptr<LineBank>> request_lines(const BankRequest& lines);
}  // namespace gpiod

}  // namespace dottrack::drivers
