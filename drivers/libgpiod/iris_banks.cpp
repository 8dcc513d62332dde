#include "drivers/libgpiod/iris_banks.h"

#include <algorithm>
#include <utility>

namespace dottrack::drivers {
namespace {

constexpr const char* kConsumer = "dottrack irises";

std::size_t bank_of(std::vector<BankRequest>& requests, const GpioChip& chip) {
  const auto known =
      std::find_if(requests.begin(), requests.end(),
                   [&](const BankRequest& request) { return request.chip.path == chip.path; });
  const auto index = static_cast<std::size_t>(known - requests.begin());
  if (known == requests.end()) requests.push_back({chip, kConsumer, {}, {}});
  return index;
}

// The line's bit, or 0 where there is no such line. A bank that outgrows its bits is refused later.
std::uint64_t add(std::vector<BankLine>& lines, std::optional<unsigned> offset,
                  const std::string& purpose) {
  if (!offset) return 0;
  lines.push_back({*offset, false, false, purpose});
  return std::uint64_t{1} << ((lines.size() - 1) % kMaxBankLines);
}

IrisLines add_iris(std::vector<BankRequest>& requests, const IrisWiring& iris,
                   const GpioChip& chip) {
  IrisLines lines;
  lines.bank = bank_of(requests, chip);
  BankRequest& request = requests[lines.bank];
  lines.step = add(request.outputs, iris.step_line, iris.name + ": step");
  lines.direction = add(request.outputs, iris.direction_line, iris.name + ": direction");
  lines.enable = add(request.outputs, iris.enable_line, iris.name + ": enable");
  lines.override_auto = add(request.outputs, iris.auto_line, iris.name + ": auto");
  lines.end_stop = add(request.inputs, iris.end_stop_line, iris.name + ": end stop");
  return lines;
}

}  // namespace

Result<IrisBanks> request_iris_lines(const std::vector<std::optional<IrisWiring>>& irises,
                                     LineBanks& banks) {
  IrisBanks taken;
  std::vector<BankRequest> requests;
  for (const std::optional<IrisWiring>& iris : irises) {
    taken.irises.emplace_back();
    if (!iris) continue;
    const Result<GpioChip> chip = banks.find(iris->chip);
    if (!chip) {
      return fail(iris->name + ": step line " + std::to_string(iris->step_line) + ": " +
                  chip.error().message);
    }
    taken.irises.back() = add_iris(requests, *iris, *chip);
  }
  for (const BankRequest& request : requests) {
    Result<std::unique_ptr<LineBank>> bank = banks.request(request);
    if (!bank) return tl::unexpected(std::move(bank.error()));
    taken.banks.push_back(*std::move(bank));
  }
  return taken;
}

}  // namespace dottrack::drivers
