#pragma once
// What each camera's image says of the light: from the target's dots while there is a pose, from
// the whole image else.

#include <array>
#include <span>

#include "app/core/camera_frame.h"
#include "app/core/exposure/dot_light.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::exposure {

struct LightReading {
  bool delivered = false;
  ImageLight image;
  int dots = 0;        // that were measured; the rest means nothing without one
  DotLight brightest;  // of them
  int saturated_px = 0;
  int saturated_around_px = 0;
  double saturated_share = 0.0;  // of the pixels inside the dots
  double speed_px_s = 0.0;       // of the fastest dot, falling off slowly when it is not seen
};

class LightMeter {
 public:
  explicit LightMeter(const core::Rig& rig) : rig_(&rig) {}

  void look_for(const core::Rig& rig) {
    rig_ = &rig;
    tracks_ = {};
  }

  // `frames` as they went into the tick that came to `result`. A dot that the pose puts into the
  // picture and that was not taken for a dot counts where most of it is saturated.
  const LightReading& read(std::size_t camera, const core::CameraFrame& frame,
                           const core::TickResult& result);

 private:
  struct Track {  // where a dot was last seen
    bool known = false;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    Time at{};
  };

  void read_dots(std::size_t camera, const ImageView& image, const core::TickResult& result);
  void add(const DotLight& dot, LightReading& reading);
  void follow(std::size_t camera, std::size_t dot, const core::DotView& view, Time at);

  const core::Rig* rig_;
  std::array<LightReading, kMaxCameras> readings_{};
  std::array<std::array<Track, core::kMaxDots>, kMaxCameras> tracks_{};
  int inside_px_ = 0;  // of the camera that is being read
};

}  // namespace dottrack::exposure
