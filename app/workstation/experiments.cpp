#include "app/workstation/experiments.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "app/workstation/calibrate/from_pictures.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/sim_run.h"
#include "app/workstation/trials.h"
#include "host_sim/scenarios/calibration_files.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_renderer.h"
#include "host_sim/world/rover.h"

namespace dottrack::workstation {
namespace {

using host_sim::Scene;

constexpr std::array kBoth = {Models::perfect, Models::calibrated};

const char* name_of(Models models) {
  return models == Models::perfect ? "perfect" : "calibrated";
}

Result<Scene> load(const std::string& name) {
  const auto file = host_sim::find_scenario(name);
  if (!file) return tl::unexpected<Error>(file.error());
  return host_sim::load_scenario(*file, {});
}

void put_dots(Scene& scene, int dots) {
  scene.target = host_sim::random_layout(dots, scene.seed);
  scene.world.bodies[*scene.vehicle].model = host_sim::make_rover(scene.target);
}

class Runner {
 public:
  explicit Runner(const ExperimentOptions& options) : options_(options) {}

  // Pictures of surveyed dots, and camera models from them.
  Result<void> calibration() {
    const Result<Scene> scene = load("calibration");
    if (!scene) return tl::unexpected<Error>(scene.error());
    const std::filesystem::path pictures = options_.out / "calibration";
    if (auto done = make_folder(pictures); !done) return done;
    const auto wrong = host_sim::write_calibration(*scene, {.seed = scene->seed}, pictures);
    if (!wrong) return tl::unexpected<Error>(wrong.error());
    if (auto done = take_pictures(*scene, pictures); !done) return done;
    calibrate::PictureRequest request;
    request.dots = pictures / "dots.csv";
    request.inputs.images = pictures;
    request.inputs.rig = pictures / "approximate" / "rig.toml";
    request.observe.threads = request.calibrate.threads = options_.threads;
    request.go_on = [&](double part) {
      return go_on(fmt::format("calibration: {:.0f} %", 100.0 * part));
    };
    const auto done = calibrate::calibrate_pictures(request);
    if (!done) return tl::unexpected<Error>(done.error());
    return calibrate::write_calibration(*done, {}, models_folder());
  }

  // The scenario under both kinds of models; `keep` takes what each run comes to.
  template <class Keep>
  Result<void> scenario(const std::string& name, Keep keep) {
    const Result<Scene> scene = load(name);
    if (!scene) return tl::unexpected<Error>(scene.error());
    host_sim::SceneRenderer renderer(*scene, options_.threads);
    for (const Models models : kBoth) {
      SimOptions sim;
      sim.out = options_.out / fmt::format("{}_{}", name, name_of(models));
      if (models == Models::calibrated) sim.models = models_folder();
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
  std::filesystem::path models_folder() const { return options_.out / "models"; }

  Result<void> take_pictures(const Scene& scene, const std::filesystem::path& folder) const {
    host_sim::SceneRenderer renderer(scene, options_.threads);
    SimOptions sim;
    sim.out = options_.out / "calibration_run";
    sim.record = folder;
    sim.pictures = false;
    const auto run = simulate(scene, renderer, sim);
    if (!run) return tl::unexpected<Error>(run.error());
    if (!run->loop.output_fault.empty()) return fail(run->loop.output_fault);
    return {};
  }

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
  auto done = runner.calibration();
  if (!done) return tl::unexpected<Error>(done.error());
  done = runner.scenario("survey_grid", [&](Models m, const Scene& scene, const auto& run) {
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
