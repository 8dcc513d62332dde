#include "tests/board/harness/pose_log.h"

#include <algorithm>

#include "tests/board/harness/candump_line.h"

namespace dottrack::board {

void PoseLog::take(const LoggedLine& line) {
  const auto frame = parse_candump_line(line.text);
  protocol::Payload payload{};
  if (!frame || frame->length != payload.size()) return;
  std::copy_n(frame->data.begin(), payload.size(), payload.begin());
  const std::lock_guard lock(mutex_);
  const auto message = decoder_.push(frame->id, payload);
  if (!message) return;
  poses_.push_back({*message, line.received, boot_});
  changed_.notify_all();
}

void PoseLog::start_boot() {
  const std::lock_guard lock(mutex_);
  earlier_incomplete_groups_ += decoder_.incomplete_groups();
  decoder_ = protocol::PoseDecoder();
  ++boot_;
}

std::size_t PoseLog::size() const {
  const std::lock_guard lock(mutex_);
  return poses_.size();
}

std::vector<ReceivedPose> PoseLog::from(std::size_t first) const {
  const std::lock_guard lock(mutex_);
  if (first >= poses_.size()) return {};
  return {poses_.begin() + static_cast<std::ptrdiff_t>(first), poses_.end()};
}

std::uint64_t PoseLog::incomplete_groups() const {
  const std::lock_guard lock(mutex_);
  return earlier_incomplete_groups_ + decoder_.incomplete_groups();
}

std::optional<std::size_t> PoseLog::wait_for(const Fits& fits, std::size_t count, std::size_t first,
                                             Duration patience) const {
  std::unique_lock lock(mutex_);
  std::optional<std::size_t> found;
  std::size_t next = first;
  std::size_t fitting = 0;
  changed_.wait_for(lock, patience, [&] {
    for (; next < poses_.size() && !found; ++next) {
      if (fits(poses_[next]) && ++fitting == count) found = next;
    }
    return found.has_value();
  });
  return found;
}

}  // namespace dottrack::board
