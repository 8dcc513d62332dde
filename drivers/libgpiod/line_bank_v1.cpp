// Lines through libgpiod 1.x, whose requests have one direction and one active level for all their
// lines and are always written whole: outputs and inputs are two requests, and what is active low
// is turned round here.

#include <gpiod.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "drivers/libgpiod/line_bank.h"

namespace dottrack::drivers::gpiod {
namespace {

struct CloseChip {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

// A bulk whose order is the request's, and what of it is active low.
struct Lines {
  gpiod_line_bulk bulk = GPIOD_LINE_BULK_INITIALIZER;
  std::uint64_t inverted = 0;
};

using Values = std::array<int, kMaxBankLines>;

Values spread(std::uint64_t bits) {
  Values values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>((bits >> i) & 1U);
  return values;
}

class Bank final : public LineBank {
 public:
  Bank(Chip chip, const Lines& outputs, const Lines& inputs, std::uint64_t values)
      : chip_(std::move(chip)), outputs_(outputs), inputs_(inputs), values_(values) {}

  ~Bank() override {
    if (outputs_.bulk.num_lines > 0) gpiod_line_release_bulk(&outputs_.bulk);
    if (inputs_.bulk.num_lines > 0) gpiod_line_release_bulk(&inputs_.bulk);
  }

 private:
  bool do_set(std::uint64_t mask, std::uint64_t values) override {
    if (outputs_.bulk.num_lines == 0) return mask == 0;
    const std::uint64_t wanted = (values_ & ~mask) | (values & mask);
    const Values levels = spread(wanted ^ outputs_.inverted);
    if (gpiod_line_set_value_bulk(&outputs_.bulk, levels.data()) != 0) return false;
    values_ = wanted;
    return true;
  }

  std::optional<std::uint64_t> do_inputs() override {
    if (inputs_.bulk.num_lines == 0) return 0;
    Values levels{};
    if (gpiod_line_get_value_bulk(&inputs_.bulk, levels.data()) != 0) return std::nullopt;
    std::uint64_t bits = 0;
    for (unsigned i = 0; i < inputs_.bulk.num_lines; ++i) {
      bits |= std::uint64_t{levels[i] != 0} << i;
    }
    return bits ^ inputs_.inverted;
  }

  Chip chip_;
  Lines outputs_;
  Lines inputs_;
  std::uint64_t values_;  // of the outputs, as they were last set
};

std::optional<std::string> user_of(gpiod_chip* chip, unsigned offset) {
  gpiod_line* line = gpiod_chip_get_line(chip, offset);
  if (line == nullptr || !gpiod_line_is_used(line)) return std::nullopt;
  const char* consumer = gpiod_line_consumer(line);
  return consumer == nullptr ? "the kernel" : consumer;
}

Lines collect(gpiod_chip* chip, const std::vector<BankLine>& wanted) {
  Lines lines;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    gpiod_line* line = gpiod_chip_get_line(chip, wanted[i].offset);
    if (line == nullptr) return {};
    gpiod_line_bulk_add(&lines.bulk, line);
    lines.inverted |= std::uint64_t{wanted[i].active_low} << i;
  }
  return lines;
}

tl::unexpected<Error> request_error(const BankRequest& request, const BankLine& first) {
  return fail(line_name(request, first) +
              " and its neighbours cannot be requested: " + std::strerror(errno));
}

Result<Lines> request_outputs(gpiod_chip* chip, const BankRequest& request, std::uint64_t values) {
  Lines lines = collect(chip, request.outputs);
  if (request.outputs.empty()) return lines;
  const Values levels = spread(values ^ lines.inverted);
  const bool granted =
      lines.bulk.num_lines == request.outputs.size() &&
      gpiod_line_request_bulk_output(&lines.bulk, request.consumer.c_str(), levels.data()) == 0;
  if (!granted) return request_error(request, request.outputs.front());
  return lines;
}

Result<Lines> request_inputs(gpiod_chip* chip, const BankRequest& request) {
  Lines lines = collect(chip, request.inputs);
  if (request.inputs.empty()) return lines;
  const bool granted = lines.bulk.num_lines == request.inputs.size() &&
                       gpiod_line_request_bulk_input(&lines.bulk, request.consumer.c_str()) == 0;
  if (!granted) return request_error(request, request.inputs.front());
  return lines;
}

tl::unexpected<Error> chip_error(const std::string& path) {
  return fail("GPIO chip " + path + ": cannot be opened: " + std::strerror(errno));
}

}  // namespace

Result<GpioChip> read_chip(const std::string& path) {
  const Chip chip(gpiod_chip_open(path.c_str()));
  if (!chip) return chip_error(path);
  return GpioChip{path, gpiod_chip_label(chip.get()), gpiod_chip_num_lines(chip.get())};
}

Result<std::unique_ptr<LineBank>> request_lines(const BankRequest& request) {
  Chip chip(gpiod_chip_open(request.chip.path.c_str()));
  if (!chip) return chip_error(request.chip.path);
  const Result<void> sound =
      check_lines(request, [&](unsigned offset) { return user_of(chip.get(), offset); });
  if (!sound) return tl::unexpected(sound.error());
  std::uint64_t values = 0;
  for (std::size_t i = 0; i < request.outputs.size(); ++i) {
    values |= std::uint64_t{request.outputs[i].active} << i;
  }
  // Inputs first: where they are refused, no output has moved.
  const Result<Lines> inputs = request_inputs(chip.get(), request);
  if (!inputs) return tl::unexpected(inputs.error());
  const Result<Lines> outputs = request_outputs(chip.get(), request, values);
  if (!outputs) return tl::unexpected(outputs.error());
  return std::make_unique<Bank>(std::move(chip), *outputs, *inputs, values);
}

}  // namespace dottrack::drivers::gpiod
