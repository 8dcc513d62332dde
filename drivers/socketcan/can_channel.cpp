#include "drivers/socketcan/can_channel.h"

#include <algorithm>
#include <utility>

namespace dottrack::drivers {
namespace {

constexpr Duration kLookEvery = std::chrono::milliseconds(20);
constexpr Duration kBindEvery = std::chrono::milliseconds(100);
constexpr Duration kRetryEvery = std::chrono::microseconds(200);
// More than a bus brings between two calls, and still a bound where errors flood.
constexpr int kMostReadsACall = 64;

void add_one(std::atomic<std::uint64_t>& count) {
  count.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

CanChannel::CanChannel(CanPort port, std::unique_ptr<CanLink> link, bool fd,
                       const rtos::Clock& clock)
    : port_(std::move(port)), link_(std::move(link)), clock_(clock), fd_(fd) {
  look_at_link();
}

hal::SendResult CanChannel::send(const hal::CanFrame& frame, Time deadline) {
  const std::optional<WireFrame> wire = to_wire(frame);
  const bool speakable = wire && (fd_ || !frame.fd);
  const hal::SendResult result = speakable ? write_until(*wire, deadline) : hal::SendResult::failed;
  switch (result) {
    case hal::SendResult::accepted:
      add_one(counts_.sent);
      break;
    case hal::SendResult::try_again:
      add_one(counts_.refused_full);
      break;
    case hal::SendResult::failed:
      add_one(counts_.failed);
      break;
  }
  return result;
}

hal::SendResult CanChannel::write_until(const WireFrame& wire, Time deadline) {
  // The number of tries is bounded even if the clock stands still.
  const Duration patience = std::max(deadline - clock_.now(), Duration::zero());
  const std::int64_t most_pauses = patience / kRetryEvery + 1;
  for (std::int64_t pauses = 0;; ++pauses) {
    catch_up();
    // Off the bus, the kernel takes frames and drops them without a word.
    if (!controller_.can_send()) return hal::SendResult::failed;
    switch (port_.write(wire)) {
      case CanPort::Written::done:
        return hal::SendResult::accepted;
      case CanPort::Written::refused:
        return hal::SendResult::failed;
      case CanPort::Written::down:
        lose(LinkState::down);
        return hal::SendResult::failed;
      case CanPort::Written::gone:
        lose(LinkState::gone);
        return hal::SendResult::failed;
      case CanPort::Written::full:
        break;
    }
    const Duration left = deadline - clock_.now();
    if (left <= Duration::zero() || pauses == most_pauses) return hal::SendResult::try_again;
    pause_for(std::min(left, kRetryEvery));
  }
}

// The inbox first: a burst longer than it waits in the kernel and is not overwritten.
bool CanChannel::receive(hal::CanFrame& frame) {
  if (inbox_.take(frame)) return true;
  catch_up();
  return inbox_.take(frame);
}

hal::CanState CanChannel::state() {
  catch_up();
  return controller_.state();
}

SocketCanCounts CanChannel::counts() const {
  const auto read = [](const Count& count) { return count.load(std::memory_order_relaxed); };
  return {.sent = read(counts_.sent),
          .refused_full = read(counts_.refused_full),
          .failed = read(counts_.failed),
          .error_frames = read(counts_.error_frames),
          .bus_offs = read(counts_.bus_offs),
          .recoveries = read(counts_.recoveries),
          .overwritten = read(counts_.overwritten)};
}

void CanChannel::catch_up() {
  read_pending();
  if (clock_.now() >= next_look_) look_at_link();
}

void CanChannel::read_pending() {
  WireFrame wire;
  for (int reads = 0; reads < kMostReadsACall; ++reads) {
    switch (port_.read(wire)) {
      case CanPort::Read::frame:
        take_in(wire);
        break;
      case CanPort::Read::nothing:
        return;
      case CanPort::Read::down:
        lose(LinkState::down);
        return;
      case CanPort::Read::gone:
        lose(LinkState::gone);
        return;
    }
  }
}

void CanChannel::take_in(const WireFrame& wire) {
  if (const std::optional<ErrorReport> report = read_error_frame(wire)) {
    add_one(counts_.error_frames);
    note(controller_.on_report(*report, clock_.now()));
    return;
  }
  const std::optional<hal::CanFrame> frame = from_wire(wire);
  if (frame && !inbox_.put(*frame)) add_one(counts_.overwritten);
}

void CanChannel::lose(LinkState link) {
  const Time now = clock_.now();
  if (bound_) next_look_ = link == LinkState::gone ? now + kBindEvery : now;
  bound_ = bound_ && link != LinkState::gone;
  note(controller_.on_link(link, now));
}

void CanChannel::look_at_link() {
  const Time now = clock_.now();
  const LinkState link = bound_ ? link_->look() : link_->bind_again();
  bound_ = link != LinkState::gone;
  next_look_ = now + (bound_ ? kLookEvery : kBindEvery);
  note(controller_.on_link(link, now));
}

void CanChannel::note(ControllerState::Change change) {
  if (change.bus_off) add_one(counts_.bus_offs);
  if (change.recovered) add_one(counts_.recoveries);
}

}  // namespace dottrack::drivers
