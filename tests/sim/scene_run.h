#pragma once
// A simulated scene before the tracker's eyes: rig through files, images in memory.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "app/config/rig_file.h"
#include "app/core/tracker.h"
#include "host_sim/scenarios/scene_files.h"
#include "host_sim/scenarios/scenes.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::test {

struct PoseError {
  double position_mm = 0.0;
  double attitude_deg = 0.0;

  // What counts as a wrong lock.
  bool wrong() const { return position_mm > 100.0 || attitude_deg > 5.0; }
};

class SceneRun {
 public:
  explicit SceneRun(host_sim::Scene scene)
      : scene_(std::move(scene)), renderer_(scene_), tracker_(load()) {}

  const host_sim::Scene& scene() const { return scene_; }

  const core::TickResult& step(std::uint64_t tick) {
    renderer_.render(tick, images_);
    std::array<core::CameraFrame, kMaxCameras> frames{};
    for (std::size_t i = 0; i < images_.size(); ++i) {
      frames[i].delivered = !covered_.contains(i);
      frames[i].image = host_sim::view(images_[i]);
    }
    return tracker_.step(frames);
  }

  // From now on this camera does not deliver.
  void cover(std::size_t camera) { covered_.insert(camera); }

  PoseError error(const core::TickResult& result, std::uint64_t tick) const {
    const host_sim::Pose truth = host_sim::truth(scene_, tick);
    const double angle_rad = result.pose.orientation.angularDistance(truth.orientation());
    return {1000.0 * (result.pose.position_m - truth.position_m).norm(),
            180.0 / std::numbers::pi * angle_rad};
  }

 private:
  core::Rig load() const {
    const TemporaryFolder folder;
    EXPECT_TRUE(host_sim::write_rig(scene_, folder.path()));
    const auto config = config::load_rig(folder.path() / "rig.toml");
    if (!config) throw std::runtime_error(config.error().message);
    return config->rig;
  }

  host_sim::Scene scene_;
  host_sim::SceneRenderer renderer_;
  core::Tracker tracker_;
  CameraSet covered_;
  std::vector<host_sim::GreyImage> images_;
};

}  // namespace dottrack::test
