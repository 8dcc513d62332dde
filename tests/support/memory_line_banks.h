#pragma once
// GPIO chips in memory: what a driver sets can be looked at, and what it reads can be set.

#include <map>
#include <set>

#include "drivers/libgpiod/line_bank.h"

namespace dottrack::test {

struct MemoryChip {
  drivers::GpioChip chip;
  std::map<unsigned, bool> levels;  // by offset; what is not there is low
  std::set<unsigned> taken;         // by a bank, now
  std::map<unsigned, std::string> users;
  int writes = 0;
  int reads = 0;
  bool broken = false;
};

class MemoryLineBanks final : public drivers::LineBanks {
 public:
  MemoryChip& add(const std::string& label, unsigned lines) {
    const std::string path = "/dev/gpiochip" + std::to_string(chips_.size());
    MemoryChip& chip = chips_[path];
    chip.chip = {path, label, lines};
    for (unsigned i = 0; i < lines; ++i) chip.levels[i] = false;
    return chip;
  }

 private:
  class Bank final : public drivers::LineBank {
   public:
    Bank(MemoryChip& chip, const drivers::BankRequest& request) : chip_(chip), request_(request) {
      for (const drivers::BankLine& line : request.outputs) {
        chip.taken.insert(line.offset);
        chip.levels[line.offset] = line.active != line.active_low;
      }
      for (const drivers::BankLine& line : request.inputs) chip.taken.insert(line.offset);
    }
    ~Bank() override {
      for (const drivers::BankLine& line : request_.outputs) chip_.taken.erase(line.offset);
      for (const drivers::BankLine& line : request_.inputs) chip_.taken.erase(line.offset);
    }

   private:
    bool do_set(std::uint64_t mask, std::uint64_t values) override {
      ++chip_.writes;
      for (std::size_t i = 0; i < request_.outputs.size(); ++i) {
        if (((mask >> i) & 1U) == 0 || chip_.broken) continue;
        const drivers::BankLine& line = request_.outputs[i];
        chip_.levels.find(line.offset)->second = (((values >> i) & 1U) != 0) != line.active_low;
      }
      return !chip_.broken;
    }

    std::optional<std::uint64_t> do_inputs() override {
      ++chip_.reads;
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < request_.inputs.size(); ++i) {
        const drivers::BankLine& line = request_.inputs[i];
        const bool active = chip_.levels.find(line.offset)->second != line.active_low;
        bits |= std::uint64_t{active} << i;
      }
      return chip_.broken ? std::nullopt : std::optional(bits);
    }

    MemoryChip& chip_;
    drivers::BankRequest request_;
  };

  Result<drivers::GpioChip> do_find(const std::string& name) override {
    for (auto& [path, chip] : chips_) {
      if (path == name || chip.chip.label == name) return chip.chip;
    }
    return fail("GPIO chip " + name + ": no chip has that label, name or path");
  }

  Result<std::unique_ptr<drivers::LineBank>> do_request(
      const drivers::BankRequest& request) override {
    MemoryChip& chip = chips_.at(request.chip.path);
    const auto user = [&](unsigned offset) -> std::optional<std::string> {
      const auto known = chip.users.find(offset);
      if (known != chip.users.end()) return known->second;
      return chip.taken.contains(offset) ? std::optional<std::string>("a bank") : std::nullopt;
    };
    if (Result<void> sound = check_lines(request, user); !sound) {
      return tl::unexpected(sound.error());
    }
    return std::make_unique<Bank>(chip, request);
  }

  std::map<std::string, MemoryChip> chips_;  // by path
};

}  // namespace dottrack::test
