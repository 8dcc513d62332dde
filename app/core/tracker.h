#pragma once
// The tracker: one call a tick, from images to a pose. Acquires until it finds the target, then
// follows it; when it has lost it for lost_after_ticks, it acquires again (paper section 3).

#include <array>
#include <cstddef>
#include <memory>

#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "hal/base/image_view.h"
#include "hal/base/time.h"

namespace dottrack::core {

struct CameraFrame {
  bool delivered = false;
  ImageView image;  // must have the camera's width and height, else it counts as not delivered
  Time mid_exposure{};
};

// All memory is taken at construction; step() allocates nothing, throws nothing and its work is
// bounded. The same frames give the same results, bit for bit.
class Tracker {
 public:
  explicit Tracker(const Rig& rig);
  ~Tracker();
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  // frames[i] belongs to camera i of the rig. The result stays valid until the next call.
  const TickResult& step(const std::array<CameraFrame, kMaxCameras>& frames);

  // Bytes this tracker occupies, all capacities included.
  std::size_t footprint_bytes() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::core
