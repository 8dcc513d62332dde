#pragma once
// Pictures of a hall through one camera. What stands still is rendered once, light by light; a
// picture then costs only what moves, and light, shadow and occlusion stay right.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/ray_scene.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/world/lamp.h"
#include "host_sim/world/motion.h"

namespace dottrack::host_sim {

// What stands still, shared by all cameras.
struct Hall {
  RayScene scene;
  std::vector<Lamp> lamps;

  Hall(const Model& model, std::vector<Lamp> hall_lamps)
      : scene(model), lamps(std::move(hall_lamps)) {}
};

// What may move; `scene` and `motion` outlive the call they are passed to.
struct MovingBody {
  const RayScene* scene = nullptr;
  const Motion* motion = nullptr;
};

// How carefully bodies and their shadows are painted. `quick`, for pictures by the thousand: fewer
// looks where faces meet, no shadows but of the lamps that matter, weak ones blocky; dots and what
// stands still are the same but for roundings of the light.
enum class Detail : std::uint8_t { full, quick };

// Not for two threads at once; two views do not disturb each other. The pictures are the same
// bytes whatever the number of threads and whatever was rendered before.
class CameraView {
 public:
  // `hall` must outlive this. Renders the still picture, light by light: seconds.
  CameraView(const Hall& hall, const SimCamera& camera, const SensorModel& sensor);
  ~CameraView();

  const SimCamera& camera() const;

  // The hall with these bodies as they move, and the lamps as they shine, during the exposure.
  void render(const Exposure& exposure, std::span<const MovingBody> bodies, const LightPlan& light,
              GreyImage& image);

  // render() in two steps: what the sensor's pixels hold when the shutter closes (sensor.h), and
  // that read out. Any number of threads may read, with one noise or another.
  void collect(const Exposure& exposure, std::span<const MovingBody> bodies, const LightPlan& light,
               Detail detail, FloatImage& charge_dn);
  void read(const FloatImage& charge_dn, const Exposure& exposure, GreyImage& image) const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace dottrack::host_sim
