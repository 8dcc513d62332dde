#pragma once
// A world, the cameras that look at it, and the clock they share.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host_sim/renderer/camera_renderer.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/world/world.h"

namespace dottrack::host_sim {

struct SceneCamera {
  std::string name;
  SimCamera camera;
  SensorModel sensor;
};

// What the rig file says of how dots appear: told to the tracker, not used to render.
struct DotAppearance {
  double distance_min_m = 2.5;
  double distance_max_m = 9.5;
  int intensity_min_dn = 70;
  int intensity_max_dn = 255;
  int min_contrast_dn = 25;
  int background_px = 41;
  double max_step_m = 0.1;
};

struct Scene {
  std::string name;
  std::uint64_t seed = 1;
  double frame_rate_hz = 30.0;
  World world;
  std::vector<SceneCamera> cameras;
  TargetLayout target;  // on the vehicle, or looked for in vain where there is none
  DotAppearance appearance;
};

// Middle of a tick's exposure, seconds; tick 0 is at 0.
double time_s(const Scene& scene, std::uint64_t tick);

// T_world_vehicle in the middle of a tick's exposure. Exposures are short: nothing is smeared.
Pose truth(const Scene& scene, std::uint64_t tick);

// Renders a scene through all of its cameras. The bytes depend on the scene and the tick alone,
// never on the number of threads.
class SceneRenderer {
 public:
  // `scene` must outlive this and stay as it is. threads 0: as many as the machine has.
  explicit SceneRenderer(const Scene& scene, unsigned threads = 0);

  // One picture a camera, in the scene's order.
  void render(std::uint64_t tick, std::vector<GreyImage>& images);

  // One camera's picture; different cameras may be rendered by different threads.
  void render_camera(std::size_t camera, std::uint64_t tick, GreyImage& image);

 private:
  const Scene& scene_;
  unsigned threads_;
  std::vector<std::unique_ptr<CameraRenderer>> renderers_;
};

}  // namespace dottrack::host_sim
