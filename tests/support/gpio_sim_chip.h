#pragma once
// A chip of the kernel's GPIO simulator: what its lines are driven to, and what pulls them.

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "drivers/libgpiod/gpio_output_line.h"

namespace dottrack::test {

class GpioSimChip {
 public:
  // The simulated chip with that label, if this kernel has one.
  static std::optional<GpioSimChip> find(const std::string& label) {
    namespace fs = std::filesystem;
    for (const drivers::GpioChip& chip : drivers::list_gpio_chips()) {
      if (chip.label != label) continue;
      std::error_code none;
      for (const fs::directory_entry& device :
           fs::directory_iterator("/sys/devices/platform", none)) {
        const fs::path lines = device.path() / fs::path(chip.path).filename();
        if (fs::exists(lines / "sim_gpio0", none)) return GpioSimChip(chip, lines);
      }
    }
    return std::nullopt;
  }

  const drivers::GpioChip& chip() const { return chip_; }

  bool level(unsigned line) const {
    int value = -1;
    std::ifstream(file(line, "value")) >> value;
    return value == 1;
  }

  // False when this process may not.
  bool pull(unsigned line, bool up) const {
    std::ofstream out(file(line, "pull"));
    out << (up ? "pull-up" : "pull-down") << std::flush;
    return out.good();
  }

 private:
  GpioSimChip(drivers::GpioChip chip, std::filesystem::path lines)
      : chip_(std::move(chip)), lines_(std::move(lines)) {}

  std::filesystem::path file(unsigned line, const char* name) const {
    return lines_ / ("sim_gpio" + std::to_string(line)) / name;
  }

  drivers::GpioChip chip_;
  std::filesystem::path lines_;
};

}  // namespace dottrack::test
