// Chips by label, name or path.

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "drivers/libgpiod/line_bank.h"

namespace dottrack::drivers {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "gpiochip";

int number_of(const fs::path& path) {
  return std::atoi(path.filename().string().substr(kPrefix.size()).c_str());
}

std::vector<fs::path> chip_paths() {
  std::vector<fs::path> paths;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator("/dev", none)) {
    const bool device = entry.is_character_file(none) && !entry.is_symlink(none);
    const std::string name = entry.path().filename().string();
    if (device && name.starts_with(kPrefix)) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b) { return number_of(a) < number_of(b); });
  return paths;
}

struct ChipList {
  std::vector<GpioChip> chips;
  std::string trouble;  // with the first chip that could not be read
};

ChipList read_chips() {
  ChipList list;
  for (const fs::path& path : chip_paths()) {
    Result<GpioChip> chip = gpiod::read_chip(path.string());
    if (chip) {
      list.chips.push_back(*std::move(chip));
    } else if (list.trouble.empty()) {
      list.trouble = std::move(chip.error().message);
    }
  }
  return list;
}

std::string name_all(const std::vector<GpioChip>& chips) {
  std::string names;
  for (const GpioChip& chip : chips) {
    names += (names.empty() ? "" : ", ") + chip.label + " (" + chip.path + ")";
  }
  return names.empty() ? "none" : names;
}

Result<GpioChip> find_by_path(const std::string& path) {
  std::error_code missing;
  const fs::path real = fs::canonical(path, missing);
  if (missing) return fail("GPIO chip " + path + ": " + missing.message());
  return gpiod::read_chip(real.string());
}

Result<GpioChip> find_gpio_chip(const std::string& chip) {
  if (chip.starts_with('/')) return find_by_path(chip);
  const ChipList list = read_chips();
  std::vector<GpioChip> found;
  for (const GpioChip& candidate : list.chips) {
    const bool named = fs::path(candidate.path).filename() == chip;
    if (named || candidate.label == chip) found.push_back(candidate);
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    return fail("GPIO chip " + chip + ": more than one has that label, " + name_all(found) +
                "; expected a path");
  }
  return fail("GPIO chip " + chip + ": no chip has that label, name or path; there are: " +
              name_all(list.chips) + (list.trouble.empty() ? "" : "; " + list.trouble));
}

class KernelLineBanks final : public LineBanks {
  Result<GpioChip> do_find(const std::string& chip) override { return find_gpio_chip(chip); }
  Result<std::unique_ptr<LineBank>> do_request(const BankRequest& lines) override {
    return gpiod::request_lines(lines);
  }
};

}  // namespace

LineBanks& kernel_line_banks() {
  static KernelLineBanks banks;
  return banks;
}

std::vector<GpioChip> list_gpio_chips() {
  return read_chips().chips;
}

}  // namespace dottrack::drivers
