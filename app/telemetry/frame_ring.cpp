#include "app/telemetry/frame_ring.h"

#include <algorithm>
#include <cassert>

namespace dottrack::telemetry {
namespace {

void copy_rows(const ImageView& image, std::uint8_t* to) {
  for (int y = 0; y < image.height_px; ++y, to += image.width_px) {
    std::copy_n(image.row(y), image.width_px, to);
  }
}

}  // namespace

FrameRing::FrameRing(std::span<const FrameSize> cameras, std::size_t slots)
    : cameras_(cameras.begin(), cameras.end()), slots_(slots) {
  assert(cameras.size() <= kMaxCameras && slots > 0);
  for (Slot& slot : slots_) {
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      const FrameSize& size = cameras_[i];
      slot.pixels[i].resize(static_cast<std::size_t>(size.width_px) *
                            static_cast<std::size_t>(size.height_px));
      slot.copy.frames[i].image = {slot.pixels[i].data(), size.width_px, size.height_px,
                                   size.width_px};
    }
  }
}

bool FrameRing::try_push(std::uint64_t tick, Time now, const hal::FrameSet& frames) {
  const std::uint64_t pushed = pushed_.load(std::memory_order_relaxed);
  if (pushed - popped_.load(std::memory_order_acquire) == slots_.size()) return false;
  Slot& slot = slots_[pushed % slots_.size()];
  slot.copy.tick = tick;
  slot.copy.copied = now;
  slot.copy.delivered = CameraSet{};
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const hal::Frame& frame = frames.frames[i];
    const bool fits = frames.delivered.contains(i) && !frame.image.empty() &&
                      frame.image.width_px == cameras_[i].width_px &&
                      frame.image.height_px == cameras_[i].height_px;
    if (!fits) continue;
    copy_rows(frame.image, slot.pixels[i].data());
    slot.copy.frames[i].mid_exposure = frame.mid_exposure;
    slot.copy.frames[i].sequence = frame.sequence;
    slot.copy.delivered.insert(i);
  }
  pushed_.store(pushed + 1, std::memory_order_release);
  return true;
}

const FrameCopy* FrameRing::front() const {
  const std::uint64_t popped = popped_.load(std::memory_order_relaxed);
  if (pushed_.load(std::memory_order_acquire) == popped) return nullptr;
  return &slots_[popped % slots_.size()].copy;
}

void FrameRing::pop() {
  popped_.store(popped_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

}  // namespace dottrack::telemetry
