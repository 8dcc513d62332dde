#include "app/workstation/sim_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "app/config/rig_file.h"
#include "app/workstation/explainer.h"
#include "app/workstation/json_object.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/loop_run.h"
#include "app/workstation/rig_warnings.h"
#include "app/workstation/sim_plots.h"
#include "host_sim/hal/frame_recorder.h"
#include "host_sim/hal/sim_can_bus.h"
#include "host_sim/hal/sim_frame_grabber.h"
#include "host_sim/hal/sim_iris.h"
#include "host_sim/scenarios/scene_files.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using host_sim::Scene;

Truth truth_of(const Scene& scene) {
  return [&scene](Time time) -> std::optional<TruePose> {
    const auto pose = host_sim::truth(scene, to_seconds(time.time_since_epoch()));
    if (!pose) return std::nullopt;
    return TruePose{pose->position_m, pose->orientation()};
  };
}

FloorPlan floor_plan(const Scene& scene) {
  FloorPlan plan{scene.length_m, scene.width_m, {}};
  for (const host_sim::SceneCamera& camera : scene.cameras) {
    plan.cameras_m.push_back(camera.camera.centre_m().head<2>());
  }
  return plan;
}

host_sim::SimGrabberSetup grabber_setup(const Scene& scene) {
  host_sim::SimGrabberSetup setup{{}, scene.grabber, scene.camera_faults, scene.seed};
  for (const host_sim::SceneCamera& camera : scene.cameras) {
    const double readout_s = camera.sensor.line_time_s * (camera.camera.height_px() - 1);
    setup.cameras.push_back({camera.exposure_s, camera.gain, readout_s});
  }
  return setup;
}

// What report.json says beyond what a replay's does.
std::vector<std::pair<std::string, std::string>> truth_members(const Scene& scene,
                                                               const SimSummary& sim) {
  const Accuracy& a = sim.accuracy;
  const auto number = [](double value) { return fmt::format("{}", value); };
  return {{"scenario", json_string(scene.name)},
          {"seed", std::to_string(scene.seed)},
          {"interrupted", sim.rows.size() < sim.ticks_asked ? "true" : "false"},
          {"wrong_lock_ticks", std::to_string(a.wrong_lock_ticks)},
          {"position_rms_mm", number(a.position_rms_mm)},
          {"position_max_mm", number(a.position_max_mm)},
          {"attitude_rms_deg", number(a.attitude_rms_deg)},
          {"attitude_max_deg", number(a.attitude_max_deg)},
          {"nees_mean", std::isfinite(a.nees_mean) ? number(a.nees_mean) : "null"},
          {"filtered_position_rms_mm", number(sim.filtered.position_rms_mm)},
          {"filtered_position_max_mm", number(sim.filtered.position_max_mm)},
          {"filtered_attitude_rms_deg", number(sim.filtered.attitude_rms_deg)},
          {"filtered_nees_mean",
           std::isfinite(sim.filtered.nees_mean) ? number(sim.filtered.nees_mean) : "null"},
          {"coasting_ticks", std::to_string(sim.filtered.coasting_ticks)},
          {"coasting_rms_mm", number(sim.filtered.coasting_rms_mm)},
          {"ticks_per_s", number(sim.ticks_per_s)}};
}

// All that a simulated run is made of.
class Simulation {
 public:
  Simulation(const Scene& scene, host_sim::SceneRenderer& renderer, const SimOptions& options,
             const config::RigConfig& config, LoopFiles files, telemetry::OutputFile truth_tum)
      : scene_(scene),
        options_(options),
        period_(period_of(config)),
        iris_(scene, *files.clock),
        grabber_(
            grabber_setup(scene),
            [&renderer](std::span<const host_sim::Exposure> exposures,
                        std::vector<host_sim::GreyImage>& images) {
              renderer.render(exposures, images);
            },
            iris_, *files.clock),
        can_(scene.can, scene.seed, *files.clock, *files.can_log),
        truth_tum_(std::move(truth_tum)),
        truth_(truth_tum_, truth_of(scene)),
        loop_(config, std::move(files),
              {grabber_, iris_, can_,
               options.pictures ? [this](std::size_t i) { return grabber_.picture(i); }
                                : std::function<ImageView(std::size_t)>{}}) {
    loop_.add(truth_);
    if (options.more != nullptr) loop_.add(*options.more);
    if (options.explain) loop_.add(explainer_.emplace(config, options.explain));
  }

  Result<void> record_to(const fs::path& folder) {
    auto recorder = host_sim::FrameRecorder::open(folder, camera_names());
    if (!recorder) return tl::unexpected<Error>(recorder.error());
    recorder_ = std::move(*recorder);
    return {};
  }

  SimSummary run() {
    const auto start = std::chrono::steady_clock::now();
    std::uint64_t tick = 0;
    while (tick < scene_.ticks && step(tick)) {
      ++tick;
      if (options_.go_on && !options_.go_on(tick)) break;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    SimSummary sim;
    sim.ticks_asked = scene_.ticks;
    sim.rows = truth_.rows();
    sim.ticks_per_s = static_cast<double>(sim.rows.size()) / took.count();
    sim.accuracy = accuracy_of(sim.rows);
    sim.filtered = filter_accuracy_of(sim.rows);
    finish(sim);
    return sim;
  }

 private:
  std::vector<std::string> camera_names() const {
    std::vector<std::string> names;
    for (const host_sim::SceneCamera& camera : scene_.cameras) names.push_back(camera.name);
    return names;
  }

  bool step(std::uint64_t tick) {
    grabber_.prepare(Time{} + static_cast<Duration::rep>(tick) * period_);
    const bool written = loop_.tick();
    if (recorder_) note(recorder_->record(tick, grabber_));
    return written && fault_.empty();
  }

  void finish(SimSummary& sim) {
    RunFacts facts;
    facts.more = truth_members(scene_, sim);
    if (explainer_) explainer_->finish();
    note(truth_tum_.finish());
    if (recorder_) note(recorder_->finish());
    if (options_.pictures) {
      note(write_plots(sim.rows, floor_plan(scene_), options_.out / "plots"));
    }
    sim.loop = loop_.finish(std::move(facts));
    if (sim.loop.output_fault.empty()) sim.loop.output_fault = fault_;
  }

  void note(const Result<void>& written) {
    if (!written && fault_.empty()) fault_ = written.error().message;
  }

  const Scene& scene_;
  const SimOptions& options_;
  Duration period_;
  host_sim::SimIris iris_;
  host_sim::SimFrameGrabber grabber_;
  host_sim::SimCanBus can_;
  telemetry::OutputFile truth_tum_;
  TruthRecord truth_;
  std::optional<Explainer> explainer_;
  LoopRun loop_;
  std::unique_ptr<host_sim::FrameRecorder> recorder_;
  std::string fault_;
};

}  // namespace

bool SimSummary::good(const Scene& scene) const {
  if (accuracy.wrong_lock_ticks > 0 || !loop.output_fault.empty()) return false;
  return scene.vehicle ? loop.first_lock_tick >= 0 : loop.first_lock_tick < 0;
}

Result<SimSummary> simulate(const Scene& scene, host_sim::SceneRenderer& renderer,
                            const SimOptions& options) {
  Result<LoopFiles> files = open_loop_files(options.out, std::make_unique<rtos::VirtualClock>());
  if (!files) return tl::unexpected<Error>(files.error());
  const fs::path rig = options.out / "rig";
  const auto told = options.models.empty()
                        ? host_sim::write_rig(scene, rig)
                        : host_sim::write_calibrated_rig(scene, rig, options.models);
  if (!told) return tl::unexpected<Error>(told.error());
  const Result<config::RigConfig> config = config::load_rig(rig / "rig.toml");
  if (!config) return tl::unexpected<Error>(config.error());
  Result<telemetry::OutputFile> truth_tum =
      telemetry::OutputFile::create(options.out / "truth.tum");
  if (!truth_tum) return tl::unexpected<Error>(truth_tum.error());
  Simulation simulation(scene, renderer, options, *config, std::move(*files),
                        std::move(*truth_tum));
  if (!options.record.empty()) {
    if (auto done = simulation.record_to(options.record); !done) {
      return tl::unexpected<Error>(done.error());
    }
  }
  print_warnings(*config);
  return simulation.run();
}

}  // namespace dottrack::workstation
