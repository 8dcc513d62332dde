#include "app/core/stale_images.h"

#include <cstddef>

#include "app/core/image_fingerprint.h"

namespace dottrack::core {

CameraSet StaleImages::update(const std::array<CameraFrame, kMaxCameras>& frames) {
  CameraSet same;
  bool any_changed = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].delivered) continue;
    const std::uint64_t now = fingerprint(frames[i].image);
    const bool is_same = known_.contains(i) && now == fingerprints_[i];
    if (is_same) same.insert(i);
    any_changed = any_changed || (known_.contains(i) && !is_same);
    fingerprints_[i] = now;
    known_.insert(i);
  }
  return any_changed ? same : CameraSet{};
}

}  // namespace dottrack::core
