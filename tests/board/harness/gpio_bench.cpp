#include "tests/board/harness/gpio_bench.h"

#include "tests/board/harness/wiring.h"

namespace dottrack::board {

GpioBench::GpioBench(std::size_t cameras)
    : irises_(cameras, IrisMechanics({kIrisTravel_steps, kIrisBacklash_steps})) {}

void GpioBench::take(std::string_view trace_line) {
  const std::lock_guard lock(mutex_);
  if (tells_of_lost_events(trace_line)) complete_ = false;
  if (const auto base = parse_gpio_base(trace_line)) {
    base_ = base;
    for (const GpioWrite& write : pending_) apply(write);
    pending_.clear();
  } else if (const auto write = parse_gpio_write(trace_line)) {
    if (base_) {
      apply(*write);
    } else {
      pending_.push_back(*write);
    }
  }
}

void GpioBench::start_boot() {
  const std::lock_guard lock(mutex_);
  base_.reset();
  pending_.clear();
  pulses_.clear();
  trigger_ = lamp_ = false;
  lamp_changes_ = 0;
  for (IrisMechanics& iris : irises_) {
    for (const auto line : {IrisMechanics::Line::step, IrisMechanics::Line::direction,
                            IrisMechanics::Line::enable, IrisMechanics::Line::override_auto}) {
      iris.set(line, false);
    }
  }
}

void GpioBench::apply(const GpioWrite& write) {
  if (write.gpio < *base_ || write.gpio >= *base_ + kGpioLines) return;
  const unsigned line = write.gpio - *base_;
  if (line == kTriggerLine) {
    if (write.high && !trigger_) pulses_.push_back(write.at);
    trigger_ = write.high;
  } else if (line == kLampLine) {
    lamp_changes_ += write.high != lamp_ ? 1U : 0U;
    lamp_ = write.high;
  } else {
    apply_to_iris(line, write.high);
  }
}

void GpioBench::apply_to_iris(unsigned line, bool high) {
  if (line / kLinesPerIris >= irises_.size()) return;
  irises_[line / kLinesPerIris].set(static_cast<IrisMechanics::Line>(line % kLinesPerIris), high);
}

IrisMechanics GpioBench::iris(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return irises_.at(camera);
}

std::vector<Time> GpioBench::trigger_pulses() const {
  const std::lock_guard lock(mutex_);
  return pulses_;
}

std::uint64_t GpioBench::lamp_changes() const {
  const std::lock_guard lock(mutex_);
  return lamp_changes_;
}

bool GpioBench::complete() const {
  const std::lock_guard lock(mutex_);
  return complete_;
}

}  // namespace dottrack::board
