#include "app/workstation/trials.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "app/config/rig_file.h"
#include "app/core/tracker.h"
#include "app/telemetry/output_file.h"
#include "app/workstation/json_object.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/rig_warnings.h"
#include "app/workstation/trial_summary.h"
#include "app/workstation/truth_record.h"
#include "host_sim/scenarios/body_scenes.h"
#include "host_sim/scenarios/dot_light.h"
#include "host_sim/scenarios/parallel.h"
#include "host_sim/scenarios/placements.h"
#include "host_sim/scenarios/scene_files.h"
#include "host_sim/scenarios/visibility.h"
#include "host_sim/world/motions.h"

namespace dottrack::workstation {
namespace {

using host_sim::GreyImage;
using host_sim::Placement;
using host_sim::Scene;
using host_sim::SceneRenderer;
using Watch = std::chrono::steady_clock;

// Placements at a time: their pictures are made camera by camera, then each is tracked by itself.
constexpr std::uint64_t kBatch = 8;

// Of a second and later look at the same placement: other noise than any placement's first.
std::uint64_t noise_of(std::uint64_t index, int tick) {
  return index + (static_cast<std::uint64_t>(tick) << 40U);
}

// A placement on its way from its index to its outcome.
struct Attempt {
  Placement placement;
  std::unique_ptr<host_sim::BodyScenes> bodies;
  std::unique_ptr<core::Tracker> tracker;
  Trial trial;
};

class Trials {
 public:
  Trials(const Scene& scene, SceneRenderer& renderer, const config::RigConfig& config,
         const TrialOptions& options)
      : scene_(scene), renderer_(renderer), config_(config), options_(options) {}

  std::vector<Trial> run(std::uint64_t first, std::uint64_t count) {
    std::vector<Attempt> attempts(count);
    for_each(count, [&](std::size_t i) { attempts[i] = placed(first + i); });
    std::vector<Attempt*> open;
    for (Attempt& attempt : attempts) open.push_back(&attempt);
    for (int tick = 0; tick < options_.ticks && !open.empty(); ++tick) {
      if (tick == 0 || options_.speed_m_s > 0.0) take_pictures(open, tick);
      for_each(open.size(), [&](std::size_t i) { step(shots_[i], *open[i], tick); });
      leave_out_locked(open);
    }
    std::vector<Trial> trials;
    for (Attempt& attempt : attempts) trials.push_back(std::move(attempt.trial));
    return trials;
  }

 private:
  void for_each(std::size_t count, const std::function<void(std::size_t)>& work) const {
    host_sim::for_each_index(count, renderer_.threads(), work);
  }

  Attempt placed(std::uint64_t index) const {
    Attempt attempt;
    Placement& placement = attempt.placement;
    placement = host_sim::random_placement(scene_, renderer_.hall().scene, scene_.seed, index);
    if (placement.vehicle && options_.speed_m_s > 0.0) {
      placement.bodies.front().motion = straight_ahead(*placement.vehicle);
    }
    attempt.bodies = std::make_unique<host_sim::BodyScenes>(placement.bodies);
    attempt.tracker = std::make_unique<core::Tracker>(config_.rig);
    Trial& trial = attempt.trial;
    trial.scene = scene_.name;
    std::replace(trial.scene.begin(), trial.scene.end(), ',', '_');  // it separates fields
    trial.seed = scene_.seed;
    trial.index = index;
    trial.ticks_allowed = options_.ticks;
    trial.dots = static_cast<int>(scene_.target.size());
    if (placement.vehicle) tell_truth(attempt);
    return attempt;
  }

  host_sim::Motion straight_ahead(const host_sim::Pose& from) const {
    const Eigen::Vector2d start = from.position_m.head<2>();
    const Eigen::Vector2d ahead = from.rotation.col(0).head<2>().normalized();
    const double yaw_rad = std::atan2(ahead.y(), ahead.x());
    return [=, this](double time_s) {
      return host_sim::placed_on(scene_.terrain, start + options_.speed_m_s * time_s * ahead,
                                 yaw_rad);
    };
  }

  // What there was to be seen in the first tick.
  void tell_truth(Attempt& attempt) const {
    const host_sim::Pose& vehicle = *attempt.placement.vehicle;
    Trial& trial = attempt.trial;
    trial.x_m = vehicle.position_m.x();
    trial.y_m = vehicle.position_m.y();
    trial.yaw_rad = std::atan2(vehicle.rotation(1, 0), vehicle.rotation(0, 0));
    const auto bodies = attempt.bodies->moving();
    const auto views = host_sim::views_of_dots(scene_.cameras, scene_.target, vehicle,
                                               renderer_.hall(), bodies, 0.0);
    const auto lights = host_sim::light_on_dots(scene_.target, vehicle, renderer_.hall(), bodies,
                                                attempt.placement.light, 0.0);
    trial.dots_in_two_views = host_sim::dots_in_two_views(views);
    for (std::size_t dot = 0; dot < views.size(); ++dot) {
      const bool lit = host_sim::well_lit(lights[dot], scene_, attempt.placement.opening);
      if (views[dot] >= 2 && lit) ++trial.dots_well_lit;
    }
  }

  double time_s(int tick) const { return tick / config_.frame_rate_hz; }

  // shots_[i] is then open[i]'s.
  void take_pictures(std::span<Attempt* const> open, int tick) {
    if (shots_.size() < open.size()) shots_.resize(open.size());
    const std::span shots = std::span(shots_).first(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) fill(shots[i], *open[i], tick);
    renderer_.collect(shots, options_.detail);
  }

  void fill(SceneRenderer::Shot& shot, const Attempt& attempt, int tick) const {
    shot.bodies = attempt.bodies->moving();
    shot.light = attempt.placement.light;
    shot.exposures.clear();
    for (const host_sim::SceneCamera& camera : scene_.cameras) {
      shot.exposures.push_back(
          {time_s(tick), camera.exposure_s, camera.gain, attempt.placement.opening, {}});
    }
  }

  // The shots of those that go on move along, as they may serve again.
  void leave_out_locked(std::vector<Attempt*>& open) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i]->trial.locked()) continue;
      if (left != i) {
        open[left] = open[i];
        std::swap(shots_[left], shots_[i]);
      }
      ++left;
    }
    open.resize(left);
  }

  void step(const SceneRenderer::Shot& shot, Attempt& attempt, int tick) const {
    std::vector<GreyImage> images(scene_.cameras.size());
    Trial& trial = attempt.trial;
    const auto frames = frames_of(shot, trial.index, tick, images);
    const auto start = Watch::now();
    const core::TickResult& result = attempt.tracker->step(frames);
    trial.acquisition += std::chrono::duration_cast<Duration>(Watch::now() - start);
    std::optional<TruePose> truth;
    if (attempt.placement.vehicle) {
      const host_sim::Pose pose = *attempt.placement.bodies.front().motion(time_s(tick));
      truth = {pose.position_m, pose.orientation()};
    }
    take(result, truth, trial);
  }

  std::array<core::CameraFrame, kMaxCameras> frames_of(const SceneRenderer::Shot& shot,
                                                       std::uint64_t index, int tick,
                                                       std::vector<GreyImage>& images) const {
    std::array<core::CameraFrame, kMaxCameras> frames{};
    const Duration period(std::llround(1e9 / config_.frame_rate_hz));
    for (std::size_t i = 0; i < images.size(); ++i) {
      renderer_.read(shot, i, {scene_.seed, i, noise_of(index, tick)}, images[i]);
      frames[i] = {true, host_sim::view(images[i]), Time{} + tick * period};
    }
    return frames;
  }

  const Scene& scene_;
  SceneRenderer& renderer_;
  const config::RigConfig& config_;
  const TrialOptions& options_;
  std::vector<SceneRenderer::Shot> shots_;  // kept for their memory
};

std::string trials_json(const Scene& scene, const TrialOptions& options, const TrialRun& run) {
  const auto flag = [](bool value) { return value ? "true" : "false"; };
  JsonObject report(0);
  report.add("scenario", json_string(scene.name));
  report.add("seed", scene.seed);
  report.add("first", options.first);
  report.add("asked", run.asked);
  report.add("interrupted", flag(run.trials.size() < run.asked));
  report.add("ticks_allowed", options.ticks);
  report.add("speed_m_s", options.speed_m_s);
  report.add("fine", flag(options.detail == host_sim::Detail::full));
  add_summary(run.trials, report);
  report.add("trials_per_s", run.trials_per_s);
  return report.text() + "\n";
}

Result<config::RigConfig> told_rig(const Scene& scene, const std::filesystem::path& folder) {
  if (auto done = host_sim::write_rig(scene, folder); !done) {
    return tl::unexpected<Error>(done.error());
  }
  return config::load_rig(folder / "rig.toml");
}

// Adds to `run` until all are done or nobody wants to go on.
void run_batches(Trials& trials, const TrialOptions& options, telemetry::OutputFile& csv,
                 TrialRun& run) {
  for (std::uint64_t done = 0; done < options.count;) {
    const std::uint64_t batch = std::min(kBatch, options.count - done);
    for (Trial& trial : trials.run(options.first + done, batch)) {
      csv.write(csv_line(trial));
      run.trials.push_back(std::move(trial));
    }
    done += batch;
    if (options.go_on && !options.go_on(done)) return;
  }
}

}  // namespace

Result<TrialRun> run_trials(const Scene& scene, SceneRenderer& renderer,
                            const TrialOptions& options) {
  if (const auto made = make_folder(options.out); !made) return tl::unexpected<Error>(made.error());
  Result<telemetry::OutputFile> csv =
      telemetry::OutputFile::create(options.out / "acquisitions.csv");
  if (!csv) return tl::unexpected<Error>(csv.error());
  const Result<config::RigConfig> config = told_rig(scene, options.out / "rig");
  if (!config) return tl::unexpected<Error>(config.error());
  print_warnings(*config);
  Trials trials(scene, renderer, *config, options);
  TrialRun run;
  run.asked = options.count;
  csv->write(trials_csv_header());
  const auto start = Watch::now();
  run_batches(trials, options, *csv, run);
  const std::chrono::duration<double> took = Watch::now() - start;
  run.trials_per_s = static_cast<double>(run.trials.size()) / took.count();
  if (auto done = csv->finish(); !done) return tl::unexpected<Error>(done.error());
  const auto calibration = options.out / "calibration.csv";
  if (auto done = telemetry::write_file(calibration, calibration_csv(run.trials)); !done) {
    return tl::unexpected<Error>(done.error());
  }
  const auto report = options.out / "report.json";
  if (auto done = telemetry::write_file(report, trials_json(scene, options, run)); !done) {
    return tl::unexpected<Error>(done.error());
  }
  return run;
}

}  // namespace dottrack::workstation
