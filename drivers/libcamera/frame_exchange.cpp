#include "drivers/libcamera/frame_exchange.h"

#include <cassert>
#include <utility>

namespace dottrack::drivers {

void FrameExchange::begin(std::unique_ptr<FrameMemory> memory, bool present) {
  assert(memory->buffers() <= kMaxBuffers);
  const std::lock_guard lock(run_);
  memory_ = std::move(memory);
  running_ = true;
  with_camera_ = 0;
  last_sequence_.reset();
  sequence_base_ = next_sequence_;
  tick_of_last_frame_ = ticks_.load();
  failures_in_row_ = 0;
  present_ = present;
}

void FrameExchange::end() {
  {
    const std::lock_guard lock(run_);
    running_ = false;
    depart();
  }
  tick_bell_.ring();  // whoever waits for this camera need not
}

void FrameExchange::note_silence() {
  {
    const std::lock_guard lock(run_);
    depart();
  }
  tick_bell_.ring();
}

void FrameExchange::depart() {
  if (!present_.exchange(false)) return;
  departed_ = true;
  ++departures_;
}

bool FrameExchange::reclaim() {
  while (next_returned()) {
  }
  while (next_failed()) {
  }
  if (handed_back_ != handed_to_tick_) return false;
  memory_.reset();
  return true;
}

std::optional<std::size_t> FrameExchange::next_returned() {
  std::uint8_t buffer = 0;
  if (!returned_.try_pop(buffer)) return std::nullopt;
  ++handed_back_;
  return buffer;
}

std::optional<std::size_t> FrameExchange::next_failed() {
  std::uint8_t buffer = 0;
  if (!failed_.try_pop(buffer)) return std::nullopt;
  return buffer;
}

void FrameExchange::completed(const Completion& completion) {
  const std::lock_guard lock(run_);
  if (!running_) return;
  --with_camera_;
  if (completion.outcome != Completion::Outcome::cancelled) count_sequence(completion.sequence);
  const bool whole = completion.outcome == Completion::Outcome::frame &&
                     memory_->accept(completion.buffer, completion.bytes_used);
  whole ? deliver(completion) : fail(completion.buffer);
}

void FrameExchange::count_sequence(std::uint32_t sequence) {
  if (last_sequence_ && sequence > *last_sequence_) gaps_ += sequence - *last_sequence_ - 1;
  last_sequence_ = sequence;
}

// Neither ring can be full: it has room for all buffers there are.
void FrameExchange::fail(std::size_t buffer) {
  ++errors_;
  ++failures_in_row_;
  (void)failed_.try_push(static_cast<std::uint8_t>(buffer));
  service_bell_.ring();
}

void FrameExchange::deliver(const Completion& completion) {
  ++frames_;
  failures_in_row_ = 0;
  tick_of_last_frame_ = ticks_.load();
  next_sequence_ = sequence_base_ + completion.sequence + 1;
  if (!present_.exchange(true) && departed_) ++returns_;
  ++handed_to_tick_;
  (void)arrived_.try_push({.mid_exposure = completion.mid_exposure,
                           .sequence = sequence_base_ + completion.sequence,
                           .buffer = static_cast<std::uint8_t>(completion.buffer)});
  tick_bell_.ring();
}

void FrameExchange::give_back(const Arrival& frame) {
  (void)returned_.try_push(frame.buffer);
}

CameraHealth FrameExchange::health() const {
  return {.present = present_,
          .frames = frames_,
          .gaps = gaps_,
          .late = late_,
          .errors = errors_,
          .departures = departures_,
          .returns = returns_};
}

}  // namespace dottrack::drivers
