#pragma once
// What each camera and iris should do next about the light (paper section 5: "more work on image
// analysis to set and control exposure dynamically").

#include <array>
#include <optional>

#include "app/core/camera_frame.h"
#include "app/core/exposure/camera_light.h"
#include "app/core/exposure/exposure_loop.h"
#include "app/core/exposure/iris_loop.h"
#include "app/core/exposure/light_meter.h"
#include "app/core/exposure/light_settings.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"

namespace dottrack::exposure {

struct CameraOrders {
  std::optional<ExposureSetting> exposure;
  IrisOrder iris;
};

// Every tick: read() each camera while its frame is there, then end_readings(), then decide() for
// each camera; what is not taken is told back at once. Every camera is a loop of its own: nothing
// that one does depends on another. Switched off, it measures, and orders nothing.
//
// While there is no lock, a camera goes by its image: by how bright its dots were when the whole
// image was as bright as it was then, or by the image's bright parts. When that does not help
// either, exposures are spread: a third of the cameras takes them three times as long, another a
// third as long, and they change places.
class LightControl {
 public:
  // The rig outlives this.
  LightControl(const core::Rig& rig, const LightSettings& settings);
  LightControl(const LightControl&) = delete;
  LightControl& operator=(const LightControl&) = delete;

  // From now on another target for the same cameras; outlives this.
  void look_for(const core::Rig& rig) { meter_.look_for(rig); }
  void read(std::size_t camera, const core::CameraFrame& frame, const core::TickResult& result);
  void end_readings(const core::TickResult& result);
  CameraOrders decide(std::size_t camera, const IrisView& iris);
  void exposure_refused(std::size_t camera);
  void iris_refused(std::size_t camera) { cameras_[camera].iris.refused(); }

  // As of the last decide().
  const CameraLight& light(std::size_t camera) const { return cameras_[camera].light; }

 private:
  struct Camera {
    LightReading reading;
    ExposureLoop exposure;
    IrisLoop iris;
    ExposureSetting before;        // the last change
    int refused_ticks = 0;         // until a camera that refused is asked again
    double dots_over_image = 0.0;  // level of the brightest dot over the image's mean; 0: unknown
    double searched_product_s = 0.0;  // around which exposures are spread
    CameraLight light;
  };

  std::optional<Brightness> brightness_of(const Camera& camera) const;
  std::optional<Brightness> image_brightness(const Camera& camera) const;
  bool at_end(const Camera& camera, const Brightness& seen) const;
  std::optional<ExposureSetting> spread(std::size_t index, const std::optional<Brightness>& seen);
  std::optional<ExposureSetting> expose(std::size_t index, const std::optional<Brightness>& seen);
  Duration longest_exposure(const Camera& camera) const;
  static bool needs_iris(const Camera& camera, const LightSettings& settings);
  static IrisWish wish_of(const Camera& camera, const LightSettings& settings);
  IrisLight iris_light(const Camera& camera, const std::optional<Brightness>& seen) const;
  static LightState state_of(const Camera& camera, const LightSettings& settings);
  static IrisCondition condition_of(const Camera& camera, const IrisView& iris);
  void remember(Camera& camera) const;
  void report(Camera& camera, const IrisView& iris) const;
  bool is_spread(const Camera& camera) const;

  LightSettings settings_;
  LightMeter meter_;
  std::array<Camera, kMaxCameras> cameras_{};
  bool has_pose_ = false;
  int searching_ticks_ = 0;  // without a pose, one after another
};

}  // namespace dottrack::exposure
