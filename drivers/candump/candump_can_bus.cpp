#include "drivers/candump/candump_can_bus.h"

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstring>
#include <utility>

namespace dottrack::drivers {
namespace {

constexpr std::size_t kPendingBytes = 65536;
constexpr std::size_t kLongestInterface = 15;  // as Linux has it
constexpr std::size_t kLongestLine = 192;      // time, interface, identifier and 64 bytes in hex

char* append_hex(std::span<const std::uint8_t> bytes, char* out) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  for (const std::uint8_t byte : bytes) {
    *out++ = kDigits[byte >> 4];
    *out++ = kDigits[byte & 0xF];
  }
  return out;
}

tl::unexpected<Error> file_error(const std::filesystem::path& path, const char* what) {
  return fail(path.string() + ": cannot " + what + " (" + std::strerror(errno) + ")");
}

}  // namespace

Result<std::unique_ptr<CandumpCanBus>> CandumpCanBus::open(const std::filesystem::path& path,
                                                           const rtos::Clock& clock,
                                                           std::string interface) {
  interface.resize(std::min(interface.size(), kLongestInterface));
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) return file_error(path, "write");
  return std::unique_ptr<CandumpCanBus>(
      new CandumpCanBus(path, std::move(file), clock, std::move(interface)));
}

CandumpCanBus::CandumpCanBus(const std::filesystem::path& path, File file, const rtos::Clock& clock,
                             std::string interface)
    : path_(path),
      file_(std::move(file)),
      clock_(clock),
      interface_(std::move(interface)),
      pending_(kPendingBytes) {}

Result<void> CandumpCanBus::flush() {
  const std::size_t size = std::exchange(pending_size_, 0);
  const bool written =
      std::fwrite(pending_.data(), 1, size, file_.get()) == size && std::fflush(file_.get()) == 0;
  if (written) return {};
  failed_ = true;
  return file_error(path_, "write");
}

hal::CanState CandumpCanBus::do_state() const {
  return failed_ ? hal::CanState::absent : hal::CanState::active;
}

hal::SendResult CandumpCanBus::do_send(const hal::CanFrame& frame, Time /*deadline*/) {
  if (failed_ || frame.length > frame.data.size()) return hal::SendResult::failed;
  if (pending_.size() - pending_size_ < kLongestLine) return hal::SendResult::try_again;
  pending_size_ += write_line(frame, pending_.data() + pending_size_);
  return hal::SendResult::accepted;
}

std::size_t CandumpCanBus::write_line(const hal::CanFrame& frame, char* line) const {
  const auto us = std::chrono::floor<std::chrono::microseconds>(clock_.now().time_since_epoch());
  const std::int64_t micros = us.count();
  const int head = std::snprintf(
      line, kLongestLine, "(%010" PRId64 ".%06" PRId64 ") %s %0*" PRIX32 "#", micros / 1000000,
      micros % 1000000, interface_.c_str(), frame.extended ? 8 : 3, frame.id);
  char* end = line + head;
  if (frame.fd) {
    *end++ = '#';
    *end++ = frame.bit_rate_switch ? '1' : '0';
  }
  end = append_hex(frame.payload(), end);
  *end++ = '\n';
  return static_cast<std::size_t>(end - line);
}

}  // namespace dottrack::drivers
