#pragma once
// A world, the cameras that look at it, and the hardware in between: all that a run needs.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/hal/hardware_model.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/renderer/sim_camera.h"
#include "host_sim/world/target_layout.h"
#include "host_sim/world/terrain.h"
#include "host_sim/world/world.h"

namespace dottrack::host_sim {

struct SceneCamera {
  std::string name;
  SimCamera camera;
  SensorModel sensor;
  double exposure_s = kReferenceExposure_s;
  double gain = 1.0;
};

// What the rig file says of how dots appear: told to the tracker, not used to render.
struct DotAppearance {
  double distance_min_m = 2.0;
  double distance_max_m = 14.0;
  int intensity_min_dn = 30;
  int intensity_max_dn = 255;
  int min_contrast_dn = 12;
  double min_contrast_part = 0.5;
  int background_px = 41;
  double max_step_m = 0.2;
};

// A part of a run that counts by itself: one line of a crane, one place of a survey.
struct Span {
  std::string name;
  double from_s = 0.0;
  double to_s = 0.0;
};

// Somebody knocks against a camera, and it stays so.
struct CameraMove {
  std::size_t camera = 0;
  double at_s = 0.0;
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  // rotation vector in camera axes
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();   // world
};

SimCamera moved(const SimCamera& camera, const CameraMove& move);

struct Scene {
  std::string name;
  std::string description;  // one line
  std::uint64_t seed = 1;
  std::uint64_t ticks = 100;
  double frame_rate_hz = 10.0;
  double length_m = 22.0;         // of the sandbox, along x; its middle is the world's origin
  double width_m = 9.0;           // along y
  Terrain terrain{22.0, 9.0, 1};  // that the world's hall is built on
  World world;
  std::size_t calibration_dots = 0;  // so many of the hall's marks, the first ones
  std::vector<SceneCamera> cameras;
  // The body that carries the target; absent in a scene with nothing but look-alikes.
  std::optional<std::size_t> vehicle;
  TargetLayout target;      // on the vehicle, or looked for in vain where there is none
  std::vector<Span> spans;  // in order of time; empty where the run is of one piece
  DotAppearance appearance;
  GrabberModel grabber;
  std::vector<CameraFault> camera_faults;
  std::vector<CameraMove> camera_moves;  // in order of time; `cameras` are as before all of them
  IrisModel iris;
  std::vector<IrisFault> iris_faults;
  bool light_control = false;  // whether the unit has it
  CanModel can;
};

// T_world_vehicle at a time; nothing while there is no vehicle in the hall.
std::optional<Pose> truth(const Scene& scene, double time_s);

}  // namespace dottrack::host_sim
