#include "app/workstation/calibrate_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/workstation/calibrate/figures.h"
#include "app/workstation/calibrate/from_pictures.h"
#include "app/workstation/calibrate/repair/repair_options.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/interrupt.h"
#include "app/workstation/progress.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using calibrate::Half;

struct Command {
  calibrate::PictureRequest pictures;
  fs::path out;
  std::string target;
  std::string polarity = "either";
  std::pair<double, double> dot_px{3.0, 60.0};
  std::optional<int> background_px;
  calibrate::RepairRequest repair;
};

Result<calibrate::PictureCalibration> measure(calibrate::PictureRequest request) {
  constexpr double kParts = 1000.0;
  Progress bar("calibrating", static_cast<std::uint64_t>(kParts), "part");
  request.go_on = [&](double part) {
    bar.show(static_cast<std::uint64_t>(kParts * part));
    return !Interrupt::wanted();
  };
  return calibrate::calibrate_pictures(request);
}

int run(Command command) {
  const Interrupt interrupt;
  calibrate::PictureRequest& pictures = command.pictures;
  pictures.observe.blobs.min_dot_px = command.dot_px.first;
  pictures.observe.blobs.max_dot_px = command.dot_px.second;
  pictures.observe.blobs.background_px = command.background_px;
  pictures.observe.either_polarity = command.polarity == "either";
  pictures.observe.blobs.polarity =
      command.polarity == "dark" ? core::Polarity::dark : core::Polarity::bright;
  pictures.observe.threads = pictures.calibrate.threads;
  const auto outcome = measure(pictures);
  if (Interrupt::wanted()) return complain("stopped before the end; nothing was written", kFailed);
  if (!outcome) return complain(outcome.error().message, kWrongUse);
  if (auto done = calibrate::write_calibration(*outcome, command.target, command.out); !done) {
    return complain(done.error().message, kFailed);
  }
  fmt::print("{}",
             calibrate::figures_table(outcome->calibration, outcome->tested, outcome->remarks));
  fmt::print("results: {}; report: {}\n", command.out.string(),
             (command.out / "report.html").string());
  return kDone;
}

int run_repair(calibrate::RepairRequest request, const Command& command) {
  request.rig = command.pictures.inputs.rig;
  request.out = command.out;
  const auto summary = calibrate::repair(request);
  if (!summary) return complain(summary.error().message, kWrongUse);
  fmt::print("{}", *summary);
  return kDone;
}

void add_inputs(CLI::App& sub, Command& command) {
  sub.add_option("--dots", command.pictures.dots,
                 "Surveyed dots (CSV): dot,x_m,y_m,z_m[,sigma_m][,diameter_m][,nx,ny,nz][,tick]")
      ->required();
  sub.add_option("--images", command.pictures.inputs.images,
                 "Folder with <camera>/<tick, six digits>.pgm or <camera>.pgm, 8-bit grey")
      ->required();
  sub.add_option("--out", command.out, "Folder for the results; made when absent")->required();
  auto* const rig = sub.add_option("--rig", command.pictures.inputs.rig,
                                   "Rig file with approximate camera models");
  auto* const models = sub.add_option("--models", command.pictures.inputs.models,
                                      "Folder with approximate models <camera>.cahv or .cahvor");
  models->excludes(rig);
  sub.add_option("--near", command.pictures.inputs.places,
                 "About where the cameras are (CSV): camera,x_m,y_m,z_m");
  sub.add_option("--seeds", command.pictures.inputs.seeds,
                 "Where a few dots are in the images (CSV): camera,dot,x_px,y_px");
  sub.add_option("--target", command.target, "Target file that the new rig file shall have");
}

void add_dots(CLI::App& sub, Command& command) {
  sub.add_option("--polarity", command.polarity, "Dots brighter or darker than their surround")
      ->capture_default_str()
      ->check(CLI::IsMember({"either", "bright", "dark"}));
  sub.add_option("--min-contrast", command.pictures.observe.blobs.min_contrast_dn,
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
         [&command](const std::string& kind) { command.pictures.calibrate.kind = kKinds.at(kind); },
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
  auto* const fit =
      add_half("--fit", command.pictures.fit, "Fit on every other dot of the survey only");
  add_half("--test", command.pictures.test, "And test on these")->needs(fit);
  sub.add_option("--seed", command.pictures.calibrate.seed,
                 "Above 0: the fit starts somewhere else; the result is the same");
  sub.add_option("--threads", command.pictures.calibrate.threads, "0: as many as the machine has")
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
