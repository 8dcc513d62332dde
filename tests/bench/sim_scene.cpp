#include "tests/bench/sim_scene.h"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "app/config/rig_file.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_files.h"
#include "host_sim/scenarios/scene_renderer.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::bench {

namespace {

template <class T>
T value_or_throw(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

host_sim::Scene clutter_with(std::size_t dots) {
  std::ifstream file(value_or_throw(host_sim::find_scenario("clutter")));
  std::ostringstream text;
  text << file.rdbuf() << "\n[vehicle]\ndots = " << dots << "\n";
  return value_or_throw(host_sim::parse_scenario(text.str(), "clutter"));
}

std::vector<host_sim::Exposure> exposures(const host_sim::Scene& scene) {
  std::vector<host_sim::Exposure> all;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const host_sim::SceneCamera& camera = scene.cameras[i];
    all.push_back({0.0, camera.exposure_s, camera.gain, 1.0, {scene.seed, i, 0}});
  }
  return all;
}

}  // namespace

SimScene::SimScene(std::size_t dots) {
  const host_sim::Scene scene = clutter_with(dots);
  host_sim::SceneRenderer renderer(scene);
  renderer.render(exposures(scene), images_);
  place_m_ = scene.world.bodies.at(scene.vehicle.value()).motion(0.0).value().position_m;
  const test::TemporaryFolder folder;
  if (auto written = host_sim::write_rig(scene, folder.path()); !written) {
    throw std::runtime_error(written.error().message);
  }
  rig_ = value_or_throw(config::load_rig(folder.path() / "rig.toml")).rig;
}

std::array<core::CameraFrame, kMaxCameras> SimScene::frames() const {
  std::array<core::CameraFrame, kMaxCameras> frames{};
  for (std::size_t i = 0; i < images_.size(); ++i) {
    frames[i] = {true, host_sim::view(images_[i]), {}};
  }
  return frames;
}

const SimScene& SimScene::of(std::size_t dots) {
  static std::map<std::size_t, SimScene> scenes;
  return scenes.try_emplace(dots, dots).first->second;
}

}  // namespace dottrack::bench
