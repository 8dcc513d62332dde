#include "app/workstation/sim_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/interrupt.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/progress.h"
#include "app/workstation/sim_run.h"
#include "app/workstation/trial_summary.h"
#include "app/workstation/trials.h"
#include "host_sim/scenarios/calibration_files.h"
#include "host_sim/scenarios/scenario_file.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;

struct SimCommand {
  std::string scenario = "drive";
  fs::path out;
  fs::path record;
  fs::path calibration;
  fs::path models;
  host_sim::SurveyOptions survey;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> ticks;
  std::uint64_t acquisitions = 0;
  std::uint64_t first = 0;
  int trial_ticks = TrialOptions{}.ticks;
  double trial_speed_m_s = TrialOptions{}.speed_m_s;
  bool fine = false;
  bool explain = false;
  unsigned threads = 0;
  bool pictures = true;
  std::string light_control;  // on or off; empty: as the scenario says
};

void print_text(const std::string& text) {
  fmt::print("{}", text);
}

Result<host_sim::Scene> load(const SimCommand& command) {
  const auto file = host_sim::find_scenario(command.scenario);
  if (!file) return tl::unexpected<Error>(file.error());
  auto scene = host_sim::load_scenario(*file, {command.seed, command.ticks});
  if (scene && !command.light_control.empty()) {
    scene->light_control = command.light_control == "on";
  }
  return scene;
}

void print_row(const std::string& what, const std::string& value) {
  fmt::print("  {:<24} {}\n", what, value);
}

void print_lock(const RunSummary& loop) {
  print_row("first lock",
            loop.first_lock_tick < 0 ? "never" : fmt::format("tick {}", loop.first_lock_tick));
  print_row("ticks with a pose", fmt::format("{} of {}", loop.tracking_ticks, loop.ticks));
  print_row("locks after the first", std::to_string(loop.reacquisitions));
}

void print_errors(const Accuracy& a) {
  print_row("position error",
            fmt::format("{:.2f} mm RMS, {:.2f} mm max", a.position_rms_mm, a.position_max_mm));
  print_row("attitude error",
            fmt::format("{:.3f} deg RMS, {:.3f} deg max", a.attitude_rms_deg, a.attitude_max_deg));
  print_row("normalised error", fmt::format("{:.1f} squared, mean (6 is true)", a.nees_mean));
}

void print_filter(const FilterAccuracy& f) {
  print_row("filtered pose", fmt::format("{:.2f} mm RMS, {:.3f} deg RMS, normalised {:.1f}",
                                         f.position_rms_mm, f.attitude_rms_deg, f.nees_mean));
  if (f.coasting_ticks == 0) return;
  print_row("coasting",
            fmt::format("{} ticks, {:.1f} mm RMS", f.coasting_ticks, f.coasting_rms_mm));
}

void print_summary(const SimSummary& sim, const SimCommand& command) {
  print_lock(sim.loop);
  print_row("wrong-lock ticks", std::to_string(sim.accuracy.wrong_lock_ticks));
  if (sim.accuracy.compared > 0) print_errors(sim.accuracy);
  if (sim.filtered.compared > 0) print_filter(sim.filtered);
  print_row("allocations in the loop", std::to_string(sim.loop.allocations_in_loop));
  print_row("speed", fmt::format("{:.1f} ticks a second, rendering included", sim.ticks_per_s));
  fmt::print("results: {}", command.out.string());
  if (command.pictures) {
    fmt::print("; pictures: {}; plots: {}", (command.out / "pictures").string(),
               (command.out / "plots").string());
  }
  fmt::print("\n");
  if (!command.calibration.empty()) {
    fmt::print("pictures of surveyed dots: {}\n", command.calibration.string());
  } else if (!command.record.empty()) {
    fmt::print("frames: {} (dottrack replay {} --frames {} --out DIR)\n", command.record.string(),
               (command.out / "rig" / "rig.toml").string(), command.record.string());
  }
}

int run_scene(const host_sim::Scene& scene, const SimCommand& command) {
  const Interrupt interrupt;
  SimOptions options;
  options.out = command.out;
  options.record = command.calibration.empty() ? command.record : command.calibration;
  options.pictures = command.pictures;
  options.models = command.models;
  if (command.explain) options.explain = print_text;
  host_sim::SceneRenderer renderer(scene, command.threads);
  std::optional<Progress> progress;
  progress.emplace(scene.name, scene.ticks, "tick");
  options.go_on = [&](std::uint64_t done) {
    progress->show(done);
    return !Interrupt::wanted();
  };
  const auto sim = simulate(scene, renderer, options);
  progress.reset();
  if (!sim) return complain(sim.error().message, kWrongUse);
  if (sim->rows.size() < sim->ticks_asked) {
    fmt::print("stopped after {} of {} ticks\n", sim->rows.size(), sim->ticks_asked);
  }
  print_summary(*sim, command);
  if (!sim->loop.output_fault.empty()) return complain(sim->loop.output_fault, kFailed);
  return sim->good(scene) ? kDone : kFailed;
}

// What `dottrack calibrate` reads, but for the frames, which the run records.
Result<void> write_calibration(const host_sim::Scene& scene, const SimCommand& command) {
  if (command.calibration.empty()) return {};
  if (const auto made = make_folder(command.calibration); !made) return made;
  host_sim::SurveyOptions survey = command.survey;
  survey.seed = scene.seed;
  const auto wrong = host_sim::write_calibration(scene, survey, command.calibration);
  if (!wrong) return tl::unexpected<Error>(wrong.error());
  if (!wrong->empty()) fmt::print("surveyed wrongly: {}\n", fmt::join(*wrong, " "));
  return {};
}

int run_placements(const host_sim::Scene& scene, const SimCommand& command) {
  const Interrupt interrupt;
  host_sim::SceneRenderer renderer(scene, command.threads);
  std::optional<Progress> progress;
  progress.emplace(scene.name, command.acquisitions, "acquisition");
  TrialOptions options;
  options.out = command.out;
  options.first = command.first;
  options.count = command.acquisitions;
  options.ticks = command.trial_ticks;
  options.speed_m_s = command.trial_speed_m_s;
  options.detail = command.fine ? host_sim::Detail::full : host_sim::Detail::quick;
  options.go_on = [&](std::uint64_t done) {
    progress->show(done);
    return !Interrupt::wanted();
  };
  const auto run = run_trials(scene, renderer, options);
  progress.reset();
  if (!run) return complain(run.error().message, kWrongUse);
  if (run->trials.size() < command.acquisitions) {
    fmt::print("stopped after {} of {} placements\n", run->trials.size(), command.acquisitions);
  }
  fmt::print("{}", summary_text(run->trials));
  print_row("speed",
            fmt::format("{:.1f} acquisitions a second, rendering included", run->trials_per_s));
  fmt::print("results: {}, calibration.csv, report.json\n",
             (command.out / "acquisitions.csv").string());
  return good(run->trials) ? kDone : kFailed;
}

int run(const SimCommand& command) {
  const auto scene = load(command);
  if (!scene) return complain(scene.error().message, kWrongUse);
  fmt::print("{}: {} ({} cameras, {} dots, seed {})\n", scene->name, scene->description,
             scene->cameras.size(), scene->target.size(), scene->seed);
  std::fflush(stdout);
  // Before the hall is rendered, which takes seconds.
  if (const auto made = make_folder(command.out); !made) {
    return complain(made.error().message, kWrongUse);
  }
  if (const auto done = write_calibration(*scene, command); !done) {
    return complain(done.error().message, kWrongUse);
  }
  return command.acquisitions == 0 ? run_scene(*scene, command) : run_placements(*scene, command);
}

void add_calibration_options(CLI::App& sub, SimCommand& command, CLI::Option& record) {
  auto* const calibration =
      sub.add_option("--calibration", command.calibration,
                     "Folder for what `dottrack calibrate` reads: the frames, the survey of the "
                     "hall's calibration dots, approximate models and the truth");
  calibration->excludes(&record);
  sub.add_option("--survey-sigma", command.survey.sigma_m,
                 "Metres, standard deviation of each coordinate of a surveyed dot")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0))
      ->needs(calibration);
  sub.add_option("--wrong-dots", command.survey.wrong_dots,
                 "So many dots are surveyed wrongly, by 3 to 10 cm")
      ->needs(calibration);
}

void add_trial_options(CLI::App& sub, SimCommand& command, CLI::Option& record) {
  auto* const acquisitions =
      sub.add_option("--acquisitions", command.acquisitions,
                     "Instead of the scenario's motion: this many random placements of the "
                     "vehicle among random clutter (of the clutter alone where the scenario has "
                     "no vehicle), an acquisition each");
  acquisitions->check(CLI::Range(1, 10000000))->excludes(&record);
  sub.add_option("--first", command.first,
                 "Index of the first placement: a long run can be made in pieces")
      ->check(CLI::Range(0, 1000000000))
      ->needs(acquisitions);
  sub.add_option("--trial-ticks", command.trial_ticks,
                 "Ticks that each placement has until there must be a lock")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000))
      ->needs(acquisitions);
  sub.add_option("--speed", command.trial_speed_m_s,
                 "Metres a second that the vehicle drives straight ahead meanwhile; 0: it stands")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0))
      ->needs(acquisitions);
  sub.add_flag("--fine", command.fine,
               "Placements rendered with every shadow, as a run's ticks are; slower")
      ->needs(acquisitions);
}

}  // namespace

void add_sim_command(CLI::App& app, int& exit_status) {
  CLI::App* const sub = app.add_subcommand("sim", "Run the loop against the simulated world.");
  const auto command = std::make_shared<SimCommand>();
  sub->add_option("scenario", command->scenario, "A scenario's name, or a file of one")
      ->capture_default_str();
  sub->add_option("--out", command->out, "Folder for the results; made when absent")->required();
  sub->add_option("--seed", command->seed, "Another seed than the scenario's");
  sub->add_option("--ticks", command->ticks, "Another length than the scenario's");
  auto* const record = sub->add_option("--record", command->record,
                                       "Folder for the frames, as `dottrack replay` reads them");
  sub->add_option("--models", command->models,
                  "Folder with what the tracker is told of its cameras, <camera>.cahvor as "
                  "`dottrack calibrate` writes them; without it the truth");
  add_calibration_options(*sub, *command, *record);
  add_trial_options(*sub, *command, *record);
  sub->add_option("--threads", command->threads, "For rendering; 0: as many as the machine has")
      ->check(CLI::Range(0, 256));
  sub->add_option("--light-control", command->light_control,
                  "on: the unit sets exposures, gains and irises; off: it leaves them alone; "
                  "without it as the scenario says")
      ->check(CLI::IsMember({"on", "off"}));
  sub->add_flag("--explain", command->explain, "Say of every tick without a pose why it has none");
  sub->add_flag("!--no-pictures", command->pictures, "No overlay pictures and no plots");
  sub->callback([command, &exit_status] { exit_status = run(*command); });
}

}  // namespace dottrack::workstation
