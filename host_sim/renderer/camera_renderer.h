#pragma once
// Pictures of a world through one camera.

#include <optional>

#include "host_sim/renderer/backdrop.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/patch.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/renderer/shadow.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/renderer/still_life.h"
#include "host_sim/renderer/vehicle_view.h"
#include "host_sim/world/world.h"

namespace dottrack::host_sim {

// What stands still is rendered at construction, so a picture costs only what moves. Not for two
// threads at once; two renderers do not disturb each other.
class CameraRenderer {
 public:
  // `world` and `camera` must outlive this.
  CameraRenderer(const World& world, const SimCamera& camera, const SensorModel& sensor);

  // The world with its vehicle, if it has one, in this pose.
  void render(const Pose& vehicle_pose, const NoiseKey& noise, GreyImage& image);

 private:
  void draw_vehicle(const VehicleView& vehicle, const PixelBox& box);
  float light_at(const VehicleView& vehicle, int x, int y, const Patches& patches) const;
  double backdrop_light(const VehicleView& vehicle, int x, int y) const;

  const World& world_;
  const SimCamera& camera_;
  Sensor sensor_;
  RayLattice rays_;
  StillLife still_;
  Backdrop backdrop_;
  LampDisc lamp_;
  FloatImage plain_;  // backdrop without the vehicle
  FloatImage plain_blurred_;
  FloatImage light_;
  FloatImage blurred_;
};

}  // namespace dottrack::host_sim
