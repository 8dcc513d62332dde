#include "drivers/libgpiod/gpio_output_line.h"

#include <utility>

#include "drivers/libgpiod/line_bank.h"

namespace dottrack::drivers {

class GpioOutputLine::Request {
 public:
  explicit Request(std::unique_ptr<LineBank> bank) : bank_(std::move(bank)) {}
  ~Request() { set(false); }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

  bool set(bool active) { return bank_->set(1, active ? 1 : 0); }

 private:
  std::unique_ptr<LineBank> bank_;
};

Result<std::unique_ptr<GpioOutputLine>> GpioOutputLine::open(const GpioLine& line,
                                                             const std::string& consumer) {
  return open(line, consumer, kernel_line_banks());
}

Result<std::unique_ptr<GpioOutputLine>> GpioOutputLine::open(const GpioLine& line,
                                                             const std::string& consumer,
                                                             LineBanks& banks) {
  const Result<GpioChip> chip = banks.find(line.chip);
  if (!chip) {
    return fail(consumer + " line " + std::to_string(line.offset) + ": " + chip.error().message);
  }
  const BankLine output{line.offset, line.active_low, false, consumer};
  Result<std::unique_ptr<LineBank>> bank = banks.request({*chip, consumer, {output}, {}});
  if (!bank) return tl::unexpected(std::move(bank.error()));
  return std::unique_ptr<GpioOutputLine>(
      new GpioOutputLine(std::make_unique<Request>(*std::move(bank))));
}

GpioOutputLine::GpioOutputLine(std::unique_ptr<Request> request) : request_(std::move(request)) {}

GpioOutputLine::~GpioOutputLine() = default;

bool GpioOutputLine::do_set(bool active) {
  return request_->set(active);
}

}  // namespace dottrack::drivers
