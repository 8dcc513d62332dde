#include "app/workstation/target_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "app/config/rig_file.h"
#include "app/config/target_admission.h"
#include "app/config/target_file.h"
#include "app/telemetry/output_file.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/target/target_drawing.h"
#include "app/workstation/target/target_table.h"

namespace dottrack::workstation {
namespace {

struct Check {
  std::string file;
  std::string rig;
  double sigma_mm = 2.0;
  bool upright = true;
};

struct Design {
  DesignRequest request;
  std::string panel;
  std::string out;
  double sigma_mm = 2.0;
  bool bright = true;
};

// The target that is judged may be that of the rig, so the rig's own are not.
Result<double> sigma_of(const Check& check) {
  if (check.rig.empty()) return check.sigma_mm * 1e-3;
  const auto config = config::load_rig(check.rig, config::Targets::taken_as_they_are);
  if (!config) return tl::unexpected<Error>(config.error());
  return config::expected_sigma_m(config->rig);
}

int judge_file(const std::filesystem::path& path, double sigma_m, bool upright) {
  const auto file = config::read_target_file(path);
  if (!file) return complain(file.error().message);
  core::Target target;
  target.dots = file->dots;
  target.upright = upright;
  const auto judgement = config::judge(target, sigma_m, kAmple);
  fmt::print("{}", target_table(target, judgement, file->names));
  return good(judgement) ? kDone : kFailed;
}

int run(const Check& check) {
  const auto sigma_m = sigma_of(check);
  if (!sigma_m) return complain(sigma_m.error().message);
  return judge_file(check.file, *sigma_m, check.upright);
}

Result<void> write_design(const Design& design, const core::Target& target) {
  const std::filesystem::path out = design.out;
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) return fail(fmt::format("{}: {}", design.out, error.message()));
  const auto polarity = design.bright ? core::Polarity::bright : core::Polarity::dark;
  if (auto done = telemetry::write_file(out / "target.csv", target_csv(target)); !done) return done;
  return telemetry::write_file(out / "target.svg",
                               target_svg(target, design.request.panel, polarity));
}

int run(Design design) {
  const auto panel = parse_panel(design.panel);
  if (!panel) {
    return complain(fmt::format(
        "--panel is \"{}\"; expected two lengths in metres, along x and y, as in 1.2x0.8",
        design.panel));
  }
  design.request.panel = *panel;
  design.request.sigma_m = design.sigma_mm * 1e-3;
  const auto target = design_target(design.request);
  if (!target) return complain(target.error().message);
  if (auto done = write_design(design, *target); !done) return complain(done.error().message);
  const auto folder = std::filesystem::path(design.out);
  const int status =
      judge_file(folder / "target.csv", design.request.sigma_m, design.request.upright);
  fmt::print("{} and target.svg: {}\n", (folder / "target.csv").string(), how_to_print(*panel));
  return status;
}

CLI::Option* add_sigma(CLI::App& command, double& sigma_mm) {
  return command
      .add_option("--sigma-mm", sigma_mm, "Expected error of a dot's place, each coordinate")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1000.0));
}

void add_check(CLI::App& target, int& exit_status) {
  CLI::App* command = target.add_subcommand("check", "How good a target is");
  const auto check = std::make_shared<Check>();
  command->add_option("FILE", check->file, "Target file (CSV)")->required();
  CLI::Option* sigma = add_sigma(*command, check->sigma_mm);
  command->add_option("--rig", check->rig, "Rig file whose cameras say how large the error is")
      ->excludes(sigma);
  command->add_flag("!--not-upright", check->upright, "The target may take any attitude");
  command->callback([check, &exit_status] { exit_status = run(*check); });
}

void add_design(CLI::App& target, int& exit_status) {
  CLI::App* command = target.add_subcommand("design", "Lays out a good target and draws it");
  const auto design = std::make_shared<Design>();
  command->add_option("N", design->request.dots, "How many dots")
      ->required()
      ->check(CLI::Range(3, 16));
  command->add_option("--panel", design->panel, "Size in metres, along x and y: 1.2x0.8")
      ->required();
  command->add_option("--out", design->out, "Folder for target.csv and target.svg")->required();
  command
      ->add_option("--diameter", design->request.diameter_m,
                   "Of the dots, in metres; without it up to 0.05, as the panel has room")
      ->check(CLI::Range(0.0001, 10.0));
  add_sigma(*command, design->sigma_mm);
  command->add_option("--seed", design->request.seed, "Another layout")->capture_default_str();
  command->add_flag("!--not-upright", design->request.upright, "The target may take any attitude");
  command->add_flag("!--dark", design->bright, "Draw dark dots on bright ground");
  command->callback([design, &exit_status] { exit_status = run(*design); });
}

}  // namespace

std::optional<Panel> parse_panel(const std::string& text) {
  constexpr double kLargest_m = 100.0;
  const auto side = [](const char* from, const char* to) -> std::optional<double> {
    double value = 0.0;
    const auto [end, error] = std::from_chars(from, to, value);
    const bool number = error == std::errc() && end == to && value > 0.0 && value <= kLargest_m;
    return number ? std::optional(value) : std::nullopt;
  };
  const auto cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const auto length_m = side(text.data(), text.data() + cross);
  const auto width_m = side(text.data() + cross + 1, text.data() + text.size());
  if (!length_m || !width_m) return std::nullopt;
  return Panel{*length_m, *width_m};
}

void add_target_command(CLI::App& app, int& exit_status) {
  CLI::App* target = app.add_subcommand("target", "Judges and designs targets");
  target->require_subcommand(1);
  add_check(*target, exit_status);
  add_design(*target, exit_status);
}

}  // namespace dottrack::workstation
