// Lines through libgpiod 2.x. The kernel grants 64 lines a request, so outputs and inputs are two.

#include <gpiod.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "drivers/libgpiod/line_bank.h"

namespace dottrack::drivers::gpiod {
namespace {

template <auto kRelease>
struct Release {
  template <class T>
  void operator()(T* object) const {
    kRelease(object);
  }
};
using Chip = std::unique_ptr<gpiod_chip, Release<gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, Release<gpiod_chip_info_free>>;
using LineInfo = std::unique_ptr<gpiod_line_info, Release<gpiod_line_info_free>>;
using LineSettings = std::unique_ptr<gpiod_line_settings, Release<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, Release<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, Release<gpiod_request_config_free>>;
using LineRequest = std::unique_ptr<gpiod_line_request, Release<gpiod_line_request_release>>;

gpiod_line_value value_of(bool active) {
  return active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}

struct Offsets {
  explicit Offsets(const std::vector<BankLine>& lines) : count(lines.size()) {
    for (std::size_t i = 0; i < count; ++i) offsets[i] = lines[i].offset;
  }
  std::array<unsigned, kMaxBankLines> offsets{};
  std::size_t count;
};

using Values = std::array<gpiod_line_value, kMaxBankLines>;

class Bank final : public LineBank {
 public:
  Bank(LineRequest driven, LineRequest read, const BankRequest& lines)
      : driven_(std::move(driven)),
        read_(std::move(read)),
        outputs_(lines.outputs),
        inputs_(lines.inputs) {}

 private:
  bool do_set(std::uint64_t mask, std::uint64_t values) override {
    std::array<unsigned, kMaxBankLines> offsets{};
    Values wanted{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < outputs_.count; ++i) {
      if (((mask >> i) & 1U) == 0) continue;
      offsets[count] = outputs_.offsets[i];
      wanted[count] = value_of(((values >> i) & 1U) != 0);
      ++count;
    }
    return count == 0 || gpiod_line_request_set_values_subset(driven_.get(), count, offsets.data(),
                                                              wanted.data()) == 0;
  }

  std::optional<std::uint64_t> do_inputs() override {
    if (inputs_.count == 0) return 0;
    Values read{};
    if (gpiod_line_request_get_values_subset(read_.get(), inputs_.count, inputs_.offsets.data(),
                                             read.data()) != 0) {
      return std::nullopt;
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < inputs_.count; ++i) {
      bits |= std::uint64_t{read[i] == GPIOD_LINE_VALUE_ACTIVE} << i;
    }
    return bits;
  }

  LineRequest driven_;
  LineRequest read_;
  Offsets outputs_;
  Offsets inputs_;
};

std::optional<std::string> user_of(gpiod_chip* chip, unsigned offset) {
  const LineInfo info(gpiod_chip_get_line_info(chip, offset));
  if (!info || !gpiod_line_info_is_used(info.get())) return std::nullopt;
  const char* consumer = gpiod_line_info_get_consumer(info.get());
  return consumer == nullptr ? "the kernel" : consumer;
}

bool add_line(gpiod_line_config* config, const BankLine& line, gpiod_line_direction direction) {
  const LineSettings settings(gpiod_line_settings_new());
  if (!settings) return false;
  gpiod_line_settings_set_active_low(settings.get(), line.active_low);
  return gpiod_line_settings_set_direction(settings.get(), direction) == 0 &&
         gpiod_line_settings_set_bias(settings.get(), GPIOD_LINE_BIAS_AS_IS) == 0 &&
         gpiod_line_settings_set_output_value(settings.get(), value_of(line.active)) == 0 &&
         gpiod_line_config_add_line_settings(config, &line.offset, 1, settings.get()) == 0;
}

LineConfig line_config(const std::vector<BankLine>& lines, gpiod_line_direction direction) {
  LineConfig config(gpiod_line_config_new());
  bool added = config != nullptr;
  for (const BankLine& line : lines) added = added && add_line(config.get(), line, direction);
  return added ? std::move(config) : nullptr;
}

tl::unexpected<Error> chip_error(const std::string& path) {
  return fail("GPIO chip " + path + ": cannot be opened: " + std::strerror(errno));
}

// No lines, no request.
Result<LineRequest> request_some(gpiod_chip* chip, const BankRequest& request,
                                 const std::vector<BankLine>& lines,
                                 gpiod_line_direction direction) {
  if (lines.empty()) return LineRequest();
  const RequestConfig config(gpiod_request_config_new());
  const LineConfig settings = line_config(lines, direction);
  LineRequest granted;
  if (config && settings) {
    gpiod_request_config_set_consumer(config.get(), request.consumer.c_str());
    granted.reset(gpiod_chip_request_lines(chip, config.get(), settings.get()));
  }
  if (granted) return granted;
  return fail(line_name(request, lines.front()) +
              " and its neighbours cannot be requested: " + std::strerror(errno));
}

}  // namespace

Result<GpioChip> read_chip(const std::string& path) {
  const Chip chip(gpiod_chip_open(path.c_str()));
  if (!chip) return chip_error(path);
  const ChipInfo info(gpiod_chip_get_info(chip.get()));
  if (!info) return chip_error(path);
  return GpioChip{path, gpiod_chip_info_get_label(info.get()),
                  static_cast<unsigned>(gpiod_chip_info_get_num_lines(info.get()))};
}

Result<std::unique_ptr<LineBank>> request_lines(const BankRequest& request) {
  const Chip chip(gpiod_chip_open(request.chip.path.c_str()));
  if (!chip) return chip_error(request.chip.path);
  const Result<void> sound =
      check_lines(request, [&](unsigned offset) { return user_of(chip.get(), offset); });
  if (!sound) return tl::unexpected(sound.error());
  // Inputs first: where they are refused, no output has moved.
  Result<LineRequest> read =
      request_some(chip.get(), request, request.inputs, GPIOD_LINE_DIRECTION_INPUT);
  if (!read) return tl::unexpected(std::move(read.error()));
  Result<LineRequest> driven =
      request_some(chip.get(), request, request.outputs, GPIOD_LINE_DIRECTION_OUTPUT);
  if (!driven) return tl::unexpected(std::move(driven.error()));
  return std::make_unique<Bank>(*std::move(driven), *std::move(read), request);
}

}  // namespace dottrack::drivers::gpiod
