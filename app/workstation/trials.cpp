#include "app/workstation/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/config/rig_file.h"
#include "app/core/tracker.h"
#include "app/telemetry/output_file.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/truth_record.h"
#include "host_sim/scenarios/body_scenes.h"
#include "host_sim/scenarios/placements.h"
#include "host_sim/scenarios/scene_files.h"
#include "host_sim/scenarios/visibility.h"

namespace dottrack::workstation {
namespace {

using host_sim::GreyImage;
using host_sim::Placement;
using host_sim::Scene;
using Watch = std::chrono::steady_clock;

std::array<core::CameraFrame, kMaxCameras> frames_of(const std::vector<GreyImage>& images) {
  std::array<core::CameraFrame, kMaxCameras> frames{};
  for (std::size_t i = 0; i < images.size(); ++i) {
    frames[i].delivered = true;
    frames[i].image = host_sim::view(images[i]);
  }
  return frames;
}

class Trials {
 public:
  Trials(const Scene& scene, host_sim::SceneRenderer& renderer, const core::Rig& rig)
      : scene_(scene), renderer_(renderer), rig_(rig) {}

  Trial run(std::uint64_t index) {
    const Placement placement =
        host_sim::random_placement(scene_, renderer_.hall().scene, scene_.seed, index);
    const host_sim::BodyScenes bodies(placement.bodies);
    renderer_.render(exposures(placement, index), bodies.moving(), placement.light, images_);
    Trial trial = described(placement, index);
    const auto views = host_sim::views_of_dots(scene_.cameras, scene_.target, placement.vehicle,
                                               renderer_.hall(), bodies.moving(), 0.0);
    trial.dots_in_two_views = host_sim::dots_in_two_views(views);
    acquire(placement, trial);
    return trial;
  }

 private:
  std::vector<host_sim::Exposure> exposures(const Placement& placement, std::uint64_t index) const {
    std::vector<host_sim::Exposure> all;
    for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
      const host_sim::SceneCamera& camera = scene_.cameras[i];
      all.push_back(
          {0.0, camera.exposure_s, camera.gain, placement.opening, {scene_.seed, i, index}});
    }
    return all;
  }

  Trial described(const Placement& placement, std::uint64_t index) const {
    Trial trial;
    trial.index = index;
    trial.x_m = placement.vehicle.position_m.x();
    trial.y_m = placement.vehicle.position_m.y();
    trial.yaw_rad = std::atan2(placement.vehicle.rotation(1, 0), placement.vehicle.rotation(0, 0));
    trial.dots = static_cast<int>(scene_.target.size());
    return trial;
  }

  void acquire(const Placement& placement, Trial& trial) {
    core::Tracker tracker(rig_);
    const auto frames = frames_of(images_);
    const auto start = Watch::now();
    const core::TickResult& result = tracker.step(frames);
    trial.acquisition = std::chrono::duration_cast<Duration>(Watch::now() - start);
    trial.reason = result.reason;
    if (!result.has_pose) return;
    const PoseError error =
        error_of(result.pose, {placement.vehicle.position_m, placement.vehicle.orientation()});
    trial.position_mm = error.position_mm();
    trial.attitude_deg = error.attitude_deg();
    trial.outcome = error.wrong_lock() ? Outcome::wrong_lock : Outcome::right_lock;
  }

  const Scene& scene_;
  host_sim::SceneRenderer& renderer_;
  const core::Rig& rig_;
  std::vector<GreyImage> images_;
};

constexpr std::string_view kHeader =
    "index,x_m,y_m,yaw_deg,dots,dots_in_two_views,outcome,reason,position_mm,attitude_deg\n";

std::string csv_line(const Trial& t) {
  return fmt::format("{},{:.4f},{:.4f},{:.2f},{},{},{},{},{:.3f},{:.4f}\n", t.index, t.x_m, t.y_m,
                     180.0 / M_PI * t.yaw_rad, t.dots, t.dots_in_two_views, to_string(t.outcome),
                     core::to_string(t.reason), t.position_mm, t.attitude_deg);
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::right_lock:
      return "right";
    case Outcome::wrong_lock:
      return "wrong";
    case Outcome::no_lock:
      return "none";
  }
  return "none";
}

TrialSummary summary_of(const std::vector<Trial>& trials, bool lockable) {
  TrialSummary summary;
  for (const Trial& trial : trials) {
    if (trial.lockable() != lockable) continue;
    ++summary.placements;
    switch (trial.outcome) {
      case Outcome::right_lock:
        ++summary.right;
        break;
      case Outcome::wrong_lock:
        ++summary.wrong;
        break;
      case Outcome::no_lock:
        ++summary.none;
        ++summary.reasons[std::string(core::to_string(trial.reason))];
        break;
    }
  }
  return summary;
}

Result<TrialRun> run_trials(const Scene& scene, host_sim::SceneRenderer& renderer,
                            const TrialOptions& options) {
  if (const auto made = make_folder(options.out); !made) return tl::unexpected<Error>(made.error());
  Result<telemetry::OutputFile> csv =
      telemetry::OutputFile::create(options.out / "acquisitions.csv");
  if (!csv) return tl::unexpected<Error>(csv.error());
  const auto rig = options.out / "rig";
  if (auto done = host_sim::write_rig(scene, rig); !done)
    return tl::unexpected<Error>(done.error());
  const Result<config::RigConfig> config = config::load_rig(rig / "rig.toml");
  if (!config) return tl::unexpected<Error>(config.error());
  Trials trials(scene, renderer, config->rig);
  TrialRun run;
  csv->write(kHeader);
  const auto start = Watch::now();
  for (std::uint64_t index = 0; index < options.count; ++index) {
    run.trials.push_back(trials.run(index));
    csv->write(csv_line(run.trials.back()));
    if (options.go_on && !options.go_on(index + 1)) break;
  }
  const std::chrono::duration<double> took = Watch::now() - start;
  run.trials_per_s = static_cast<double>(run.trials.size()) / took.count();
  if (auto done = csv->finish(); !done) return tl::unexpected<Error>(done.error());
  return run;
}

}  // namespace dottrack::workstation
