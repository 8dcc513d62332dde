#include "drivers/socketcan/error_frame.h"

#include <linux/can/error.h>

#include <algorithm>

namespace dottrack::drivers {
namespace {

constexpr std::size_t kControllerByte = 1;
constexpr std::size_t kSendErrorsByte = 6;
constexpr std::size_t kReceiveErrorsByte = 7;

// The worse of the two directions counts.
std::optional<hal::CanState> told_fault(std::uint8_t controller) {
  constexpr unsigned kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
  constexpr unsigned kWarning = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
  if ((controller & kPassive) != 0) return hal::CanState::passive;
  if ((controller & kWarning) != 0) return hal::CanState::warning;
  if ((controller & CAN_ERR_CRTL_ACTIVE) != 0) return hal::CanState::active;
  return std::nullopt;  // an overflow, say, which changes nothing
}

hal::CanState counted_fault(std::uint8_t errors) {
  if (errors >= CAN_ERROR_PASSIVE_THRESHOLD) return hal::CanState::passive;
  if (errors >= CAN_ERROR_WARNING_THRESHOLD) return hal::CanState::warning;
  return hal::CanState::active;
}

}  // namespace

std::optional<ErrorReport> read_error_frame(const WireFrame& wire) {
  const canfd_frame& raw = wire.frame;
  if (wire.size != CAN_MTU || (raw.can_id & CAN_ERR_FLAG) == 0) return std::nullopt;
  ErrorReport report;
  report.bus_off = (raw.can_id & CAN_ERR_BUSOFF) != 0;
  report.restarted = (raw.can_id & CAN_ERR_RESTARTED) != 0;
  if ((raw.can_id & CAN_ERR_CRTL) != 0) report.fault = told_fault(raw.data[kControllerByte]);
  if ((raw.can_id & CAN_ERR_CNT) != 0) {
    report.counts =
        counted_fault(std::max(raw.data[kSendErrorsByte], raw.data[kReceiveErrorsByte]));
  }
  return report;
}

}  // namespace dottrack::drivers
