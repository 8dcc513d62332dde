#include "app/workstation/survey_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/config/rig_file.h"
#include "app/telemetry/output_file.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/survey/target_bundle.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;

struct Survey {
  std::vector<fs::path> runs;
  fs::path rig;
  fs::path out;
};

std::string target_csv(const core::Target& given, const LearnedTarget& learned) {
  std::string text = "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz\n";
  for (std::size_t i = 0; i < learned.dots.size(); ++i) {
    const Eigen::Vector3d& p = learned.dots[i].position_m;
    text +=
        fmt::format("{},{:.7f},{:.7f},{:.7f},{}", i, p.x(), p.y(), p.z(), given.dots[i].diameter_m);
    const auto& normal = given.dots[i].normal;
    text += normal ? fmt::format(",{},{},{}\n", normal->x(), normal->y(), normal->z()) : ",,,\n";
  }
  return text;
}

std::string sigma_csv(const LearnedTarget& learned) {
  std::string text = "dot,moved_x_m,moved_y_m,moved_z_m,sigma_x_m,sigma_y_m,sigma_z_m,views\n";
  for (std::size_t i = 0; i < learned.dots.size(); ++i) {
    const LearnedDot& dot = learned.dots[i];
    text += fmt::format("{},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f},{:.7f},{}\n", i, dot.moved_m.x(),
                        dot.moved_m.y(), dot.moved_m.z(), dot.sigma_m.x(), dot.sigma_m.y(),
                        dot.sigma_m.z(), dot.views);
  }
  return text;
}

void print(const LearnedTarget& learned) {
  fmt::print("{} views in {} ticks, {:.3f} px RMS\n", learned.views, learned.ticks, learned.rms_px);
  fmt::print("  dot  moved by (mm)     x        y        z   uncertain by (mm)\n");
  for (std::size_t i = 0; i < learned.dots.size(); ++i) {
    const LearnedDot& dot = learned.dots[i];
    const Eigen::Vector3d mm = 1000.0 * dot.moved_m;
    fmt::print("  {:3}  {:13.2f} {:8.2f} {:8.2f} {:8.2f}   {:.2f}\n", i, mm.norm(), mm.x(), mm.y(),
               mm.z(), 1000.0 * dot.sigma_m.norm());
  }
}

fs::path sigma_file(const fs::path& out) {
  return out.parent_path() / (out.stem().string() + "_sigma.csv");
}

int run(const Survey& survey) {
  const auto config = config::load_rig(survey.rig, config::Targets::taken_as_they_are);
  if (!config) return complain(config.error().message);
  std::vector<RecordedTick> ticks;
  for (const fs::path& run : survey.runs) {
    const auto more = read_run(run, *config);
    if (!more) return complain(more.error().message);
    ticks.insert(ticks.end(), more->begin(), more->end());
  }
  const auto learned = learn_target(config->rig, ticks);
  if (!learned) return complain(learned.error().message);
  const auto target = target_csv(config->rig.target, *learned);
  for (const auto& [file, text] :
       {std::pair{survey.out, target}, std::pair{sigma_file(survey.out), sigma_csv(*learned)}}) {
    if (const auto done = telemetry::write_file(file, text); !done) {
      return complain(done.error().message);
    }
  }
  print(*learned);
  fmt::print("target: {}; uncertainties: {}\n", survey.out.string(),
             sigma_file(survey.out).string());
  return kDone;
}

}  // namespace

void add_survey_command(CLI::App& app, int& exit_status) {
  CLI::App* const sub =
      app.add_subcommand("survey", "Learn where a target's dots are from recorded runs.");
  const auto survey = std::make_shared<Survey>();
  sub->add_option("runs", survey->runs, "Folders with the poses.csv of runs, or such files")
      ->required();
  sub->add_option("--rig", survey->rig, "The rig of these runs, with the target as it is known")
      ->required();
  sub->add_option("--out", survey->out, "The target file to write (target.csv)")->required();
  sub->callback([survey, &exit_status] { exit_status = run(*survey); });
}

}  // namespace dottrack::workstation
