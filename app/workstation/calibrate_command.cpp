#include "app/workstation/calibrate_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/telemetry/output_file.h"
#include "app/workstation/calibrate/camera_inputs.h"
#include "app/workstation/calibrate/figures.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/labelling/observe.h"
#include "app/workstation/calibrate/repair/repair_options.h"
#include "app/workstation/calibrate/report/report.h"
#include "app/workstation/calibrate/report/rig_files.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/interrupt.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/progress.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using calibrate::Half;

struct Command {
  fs::path dots;
  calibrate::InputFiles inputs;
  fs::path out;
  std::string target;
  std::string polarity = "either";
  std::pair<double, double> dot_px{3.0, 60.0};
  std::optional<int> background_px;
  std::optional<Half> fit;
  std::optional<Half> test;
  calibrate::ObserveOptions observe;
  calibrate::CalibrationOptions calibrate;
  calibrate::RepairRequest repair;
};

// The whole job is a thousand parts; finding the dots is the first third of it.
class Bar {
 public:
  void observed(double part) { bar_.show(static_cast<std::uint64_t>(kObserving * part)); }
  void calibrated(double part) {
    bar_.show(static_cast<std::uint64_t>(kObserving + (kAll - kObserving) * part));
  }

 private:
  static constexpr double kAll = 1000.0;
  static constexpr double kObserving = 300.0;
  Progress bar_{"calibrating", static_cast<std::uint64_t>(kAll), "part"};
};

struct Outcome {
  std::vector<calibrate::SurveyedDot> dots;
  calibrate::Calibration calibration;
  std::optional<calibrate::HalfFigures> tested;
  std::vector<std::string> remarks;
};

Result<Outcome> measure(const Command& command) {
  Bar bar;
  Outcome outcome;
  auto dots = calibrate::read_survey(command.dots);
  if (!dots) return tl::unexpected<Error>(dots.error());
  outcome.dots = std::move(*dots);
  const auto inputs = calibrate::read_inputs(command.inputs, outcome.dots);
  if (!inputs) return tl::unexpected<Error>(inputs.error());
  calibrate::ObserveOptions observe = command.observe;
  observe.progress = [&bar](double part) { bar.observed(part); };
  auto observed = calibrate::observe(outcome.dots, *inputs, observe);
  if (!observed) return tl::unexpected<Error>(observed.error());
  outcome.remarks = std::move(observed->remarks);
  calibrate::CalibrationOptions options = command.calibrate;
  options.progress = [&bar](double part, const std::string&) {
    bar.calibrated(part);
    return !Interrupt::wanted();
  };
  const auto views =
      command.fit ? calibrate::half_of(observed->views, *command.fit) : observed->views;
  auto calibration = calibrate::calibrate(outcome.dots, views, options);
  if (!calibration) return tl::unexpected<Error>(calibration.error());
  outcome.calibration = std::move(*calibration);
  if (command.test) {
    outcome.tested =
        calibrate::figures_of(outcome.dots, observed->views, outcome.calibration, *command.test);
  }
  return outcome;
}

// Of another kind than the new ones: a later run would find two models of a camera.
void remove_older_models(const fs::path& folder, const calibrate::Calibration& calibration) {
  std::error_code ignored;
  for (const calibrate::CameraCalibration& camera : calibration.cameras) {
    for (const char* kind : {".cahv", ".cahvor", ".cahvore"}) {
      fs::remove(folder / (camera.name + kind), ignored);
    }
  }
}

Result<void> write_all(const Command& command, const Outcome& outcome) {
  if (auto made = make_folder(command.out); !made) return made;
  calibrate::RigRequest request;
  if (!command.target.empty()) request.target = command.target;
  auto files = calibrate::rig_files(outcome.calibration, request);
  if (!files) return tl::unexpected<Error>(files.error());
  calibrate::ReportRequest report;
  report.remarks = outcome.remarks;
  files->push_back(
      {"report.html", calibrate::report_html(outcome.calibration, outcome.dots, report)});
  files->push_back({"residuals.csv", calibrate::residuals_csv(outcome.dots, outcome.calibration)});
  files->push_back({"report.json", calibrate::figures_json(outcome.dots, outcome.calibration,
                                                           outcome.tested, outcome.remarks)});
  remove_older_models(command.out, outcome.calibration);
  for (const calibrate::RigFile& file : *files) {
    if (auto done = telemetry::write_file(command.out / file.name, file.text); !done) return done;
  }
  return {};
}

int complain(const std::string& message, int status) {
  fmt::print(stderr, "dottrack: {}\n", message);
  return status;
}

int run(Command command) {
  const Interrupt interrupt;
  command.observe.blobs.min_dot_px = command.dot_px.first;
  command.observe.blobs.max_dot_px = command.dot_px.second;
  command.observe.blobs.background_px = command.background_px;
  command.observe.either_polarity = command.polarity == "either";
  command.observe.blobs.polarity =
      command.polarity == "dark" ? core::Polarity::dark : core::Polarity::bright;
  command.observe.threads = command.calibrate.threads;
  const auto outcome = measure(command);
  if (Interrupt::wanted()) return complain("stopped before the end; nothing was written", kFailed);
  if (!outcome) return complain(outcome.error().message, kWrongUse);
  if (auto done = write_all(command, *outcome); !done) {
    return complain(done.error().message, kFailed);
  }
  fmt::print("{}",
             calibrate::figures_table(outcome->calibration, outcome->tested, outcome->remarks));
  fmt::print("results: {}; report: {}\n", command.out.string(),
             (command.out / "report.html").string());
  return kDone;
}

int run_repair(calibrate::RepairRequest request, const Command& command) {
  request.rig = command.inputs.rig;
  request.out = command.out;
  const auto summary = calibrate::repair(request);
  if (!summary) return complain(summary.error().message, kWrongUse);
  fmt::print("{}", *summary);
  return kDone;
}

void add_inputs(CLI::App& sub, Command& command) {
  sub.add_option("--dots", command.dots,
                 "Surveyed dots (CSV): dot,x_m,y_m,z_m[,sigma_m][,diameter_m][,nx,ny,nz][,tick]")
      ->required();
  sub.add_option("--images", command.inputs.images,
                 "Folder with <camera>/<tick, six digits>.pgm or <camera>.pgm, 8-bit grey")
      ->required();
  sub.add_option("--out", command.out, "Folder for the results; made when absent")->required();
  auto* const rig =
      sub.add_option("--rig", command.inputs.rig, "Rig file with approximate camera models");
  auto* const models = sub.add_option("--models", command.inputs.models,
                                      "Folder with approximate models <camera>.cahv or .cahvor");
  models->excludes(rig);
  sub.add_option("--near", command.inputs.places,
                 "About where the cameras are (CSV): camera,x_m,y_m,z_m");
  sub.add_option("--seeds", command.inputs.seeds,
                 "Where a few dots are in the images (CSV): camera,dot,x_px,y_px");
  sub.add_option("--target", command.target, "Target file that the new rig file shall have");
}

void add_dots(CLI::App& sub, Command& command) {
  sub.add_option("--polarity", command.polarity, "Dots brighter or darker than their surround")
      ->capture_default_str()
      ->check(CLI::IsMember({"either", "bright", "dark"}));
  sub.add_option("--min-contrast", command.observe.blobs.min_contrast_dn,
                 "Grey levels between a dot and its surround")
      ->capture_default_str()
      ->check(CLI::Range(1, 254));
  sub.add_option("--background-px", command.background_px,
                 "Width of the surround; without it one for small dots and one for large ones")
      ->check(CLI::Range(3, 255));
  sub.add_option("--dot-px", command.dot_px, "Least and largest extent of a dot in an image")
      ->capture_default_str();
}

void add_fit(CLI::App& sub, Command& command) {
  using calibrate::ModelKind;
  static const std::map<std::string, ModelKind> kKinds{{"auto", ModelKind::automatic},
                                                       {"cahv", ModelKind::cahv},
                                                       {"cahv-radial", ModelKind::cahv_radial},
                                                       {"cahvor", ModelKind::cahvor},
                                                       {"cahvore", ModelKind::cahvore}};
  sub.add_option_function<std::string>(
         "--model",
         [&command](const std::string& kind) { command.calibrate.kind = kKinds.at(kind); },
         "Of all cameras; auto: chosen for each by hold-out")
      ->check(CLI::IsMember({"auto", "cahv", "cahv-radial", "cahvor", "cahvore"}));
  const auto add_half = [&sub](const char* name, std::optional<Half>& half, const char* what) {
    return sub
        .add_option_function<std::string>(
            name,
            [&half](const std::string& word) { half = word == "odd" ? Half::odd : Half::even; },
            what)
        ->check(CLI::IsMember({"odd", "even"}));
  };
  auto* const fit = add_half("--fit", command.fit, "Fit on every other dot of the survey only");
  add_half("--test", command.test, "And test on these")->needs(fit);
  sub.add_option("--seed", command.calibrate.seed,
                 "Above 0: the fit starts somewhere else; the result is the same");
  sub.add_option("--threads", command.calibrate.threads, "0: as many as the machine has")
      ->check(CLI::Range(0, 256));
}

}  // namespace

void add_calibrate_command(CLI::App& app, int& exit_status) {
  CLI::App* const sub =
      app.add_subcommand("calibrate", "Camera models from pictures of surveyed dots.");
  const auto command = std::make_shared<Command>();
  add_inputs(*sub, *command);
  add_dots(*sub, *command);
  add_fit(*sub, *command);
  calibrate::add_repair_options(*sub, command->repair);
  sub->callback([command, &exit_status] {
    exit_status =
        command->repair.camera.empty() ? run(*command) : run_repair(command->repair, *command);
  });
}

}  // namespace dottrack::workstation
