#include "drivers/libgpiod/line_bank.h"

#include <map>

namespace dottrack::drivers {
namespace {

std::vector<const BankLine*> all_lines(const BankRequest& lines) {
  std::vector<const BankLine*> all;
  for (const BankLine& line : lines.outputs) all.push_back(&line);
  for (const BankLine& line : lines.inputs) all.push_back(&line);
  return all;
}

}  // namespace

std::string line_name(const BankRequest& lines, const BankLine& line) {
  return line.purpose + " line " + std::to_string(line.offset) + " of GPIO chip " +
         lines.chip.label + " (" + lines.chip.path + ")";
}

Result<void> check_lines(const BankRequest& lines, const LineUser& user) {
  if (lines.outputs.size() > kMaxBankLines || lines.inputs.size() > kMaxBankLines) {
    return fail(lines.consumer + ": too many lines of GPIO chip " + lines.chip.label +
                "; expected at most 64 outputs and 64 inputs");
  }
  std::map<unsigned, const BankLine*> used;
  for (const BankLine* line : all_lines(lines)) {
    const std::string name = line_name(lines, *line);
    if (line->offset >= lines.chip.lines) {
      return fail(name + ": no such line; expected 0 to " + std::to_string(lines.chip.lines - 1));
    }
    const auto [other, fresh] = used.emplace(line->offset, line);
    if (!fresh) {
      return fail(name + " is also " + other->second->purpose + "; expected a line of its own");
    }
    if (const auto holder = user(line->offset)) {
      return fail(name + " is in use by " + *holder + "; expected a free line");
    }
  }
  return {};
}

}  // namespace dottrack::drivers
