#include "app/workstation/experiments.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/workstation/loop_files.h"
#include "app/workstation/sim_run.h"
#include "app/workstation/trials.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_renderer.h"
#include "host_sim/survey/calibration.h"
#include "host_sim/world/rover.h"

namespace dottrack::workstation {
namespace {

using host_sim::Scene;

// Surveyed dots on the floor and the walls, of which each camera is fitted to the 60 or fewer that
// it sees; their survey is good to a millimetre.
constexpr std::size_t kCalibrationDots = 600;
constexpr double kDotsUpTo_m = 2.5;

constexpr std::array kBoth = {Models::perfect, Models::calibrated};

const char* name_of(Models models) {
  return models == Models::perfect ? "perfect" : "calibrated";
}

Result<Scene> load(const std::string& name) {
  const auto file = host_sim::find_scenario(name);
  if (!file) return tl::unexpected<Error>(file.error());
  return host_sim::load_scenario(*file, {});
}

Result<std::vector<host_sim::SimCamera>> told_cameras(const Scene& scene, Models models) {
  std::vector<host_sim::SimCamera> cameras;
  for (const host_sim::SceneCamera& camera : scene.cameras) cameras.push_back(camera.camera);
  if (models == Models::perfect) return cameras;
  host_sim::CalibrationOptions options;
  options.seed = scene.seed;
  const auto dots = host_sim::calibration_dots(scene.length_m, scene.width_m, kDotsUpTo_m,
                                               kCalibrationDots, scene.seed);
  return host_sim::calibrated(cameras, dots, options);
}

void put_dots(Scene& scene, int dots) {
  scene.target = host_sim::random_layout(dots, scene.seed);
  scene.world.bodies[*scene.vehicle].model = host_sim::make_rover(scene.target);
}

class Runner {
 public:
  explicit Runner(const ExperimentOptions& options) : options_(options) {}

  // The scenario under both kinds of models; `keep` takes what each run comes to.
  template <class Keep>
  Result<void> scenario(const std::string& name, Keep keep) {
    const Result<Scene> scene = load(name);
    if (!scene) return tl::unexpected<Error>(scene.error());
    host_sim::SceneRenderer renderer(*scene, options_.threads);
    for (const Models models : kBoth) {
      const auto told = told_cameras(*scene, models);
      if (!told) return tl::unexpected<Error>(told.error());
      SimOptions sim;
      sim.out = options_.out / fmt::format("{}_{}", name, name_of(models));
      sim.models = *told;
      sim.go_on = [&](std::uint64_t done) {
        return go_on(
            fmt::format("{}, {} models: tick {} of {}", name, name_of(models), done, scene->ticks));
      };
      const auto run = simulate(*scene, renderer, sim);
      if (!run) return tl::unexpected<Error>(run.error());
      if (!run->loop.output_fault.empty()) return fail(run->loop.output_fault);
      if (run->rows.size() < run->ticks_asked) return stopped();
      keep(models, *scene, *run);
    }
    return {};
  }

  Result<void> acquisitions(std::vector<AcquisitionFigures>& figures) {
    Result<Scene> scene = load("drive");
    if (!scene) return tl::unexpected<Error>(scene.error());
    host_sim::SceneRenderer renderer(*scene, options_.threads);
    for (const int dots : {3, 4, 8}) {
      put_dots(*scene, dots);
      TrialOptions trials;
      trials.out = options_.out / fmt::format("acquisitions_{}", dots);
      trials.count = options_.placements;
      trials.go_on = [&](std::uint64_t done) {
        return go_on(fmt::format("acquisition, {} dots: placement {} of {}", dots, done,
                                 options_.placements));
      };
      const auto run = run_trials(*scene, renderer, trials);
      if (!run) return tl::unexpected<Error>(run.error());
      if (run->trials.size() < trials.count) return stopped();
      figures.push_back(acquisition_figures(dots, run->trials));
    }
    return {};
  }

 private:
  static tl::unexpected<Error> stopped() {
    return fail("stopped before the experiments were done");
  }

  bool go_on(const std::string& what) const { return !options_.go_on || options_.go_on(what); }

  const ExperimentOptions& options_;
};

}  // namespace

Result<Experiments> run_experiments(const ExperimentOptions& options) {
  if (const auto made = make_folder(options.out); !made) return tl::unexpected<Error>(made.error());
  Experiments all;
  Runner runner(options);
  auto done = runner.scenario("survey_grid", [&](Models m, const Scene& scene, const auto& run) {
    all.survey[static_cast<int>(m)] = survey_figures(run.rows, scene.spans);
  });
  if (!done) return tl::unexpected<Error>(done.error());
  done = runner.scenario("crane_lines", [&](Models m, const Scene& scene, const auto& run) {
    all.lines[static_cast<int>(m)] = line_figures(run.rows, scene.spans);
  });
  if (!done) return tl::unexpected<Error>(done.error());
  done = runner.scenario("ramp", [&](Models m, const Scene&, const auto& run) {
    all.ramp[static_cast<int>(m)] = drive_figures(run.rows);
  });
  if (!done) return tl::unexpected<Error>(done.error());
  done = runner.scenario("drive", [&](Models m, const Scene&, const auto& run) {
    all.drive[static_cast<int>(m)] = drive_figures(run.rows);
  });
  if (!done) return tl::unexpected<Error>(done.error());
  done = runner.acquisitions(all.acquisitions);
  if (!done) return tl::unexpected<Error>(done.error());
  return all;
}

}  // namespace dottrack::workstation
