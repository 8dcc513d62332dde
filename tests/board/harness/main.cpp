// The virtual board's test: makes the rig's files, and runs the image.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <system_error>

#include "host_sim/scenarios/scenario_file.h"
#include "tests/board/harness/findings.h"
#include "tests/board/harness/unit_rig.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::board {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

struct Options {
  std::filesystem::path scenario;
  std::filesystem::path folder;  // of the rig's files
  EmulatorSetup emulator;
  std::size_t poses = 100;
  std::vector<std::string> only;  // of the faults; all when empty
};

int complain(const Error& error, int status) {
  fmt::print(stderr, "dottrack_board: {}\n", error.message);
  return status;
}

struct Fault {
  const char* name;
  Finding (*look)(Board&);
};

constexpr std::array kFaults{
    Fault{"camera", camera_unplugged}, Fault{"can", can_bus_down},
    Fault{"rig", broken_rig_file},     Fault{"exposure", other_exposure},
    Fault{"light", lamps_dimmed},      Fault{"disk", recording_disk_full},
    Fault{"hang", process_stopped},    Fault{"end", told_to_end},
    Fault{"measure", measuring},       Fault{"tests", hardware_tests},
};

class Report {
 public:
  explicit Report(std::filesystem::path file) : file_(std::move(file)) {}

  void add(const Finding& finding) {
    verdict_.add(finding);
    fmt::print("{}\n", table_line(finding));
    std::fflush(stdout);
    std::ofstream(file_, std::ios::trunc) << verdict_.json();
  }
  bool all_hold() const { return verdict_.all_hold(); }

 private:
  std::filesystem::path file_;
  Verdict verdict_;
};

bool wanted(const Options& options, const std::string& fault) {
  return options.only.empty() ||
         std::find(options.only.begin(), options.only.end(), fault) != options.only.end();
}

void look_at(Board& board, const Options& options, Report& report) {
  if (auto ready = board.set_up_guest(); !ready) {
    report.add({"boot", false, ready.error().message});
    return;
  }
  for (const Finding& finding : nominal_findings(board, options.poses)) report.add(finding);
  if (!report.all_hold()) return;  // a unit that does not track has nothing to lose
  for (const Fault& fault : kFaults) {
    if (wanted(options, fault.name)) report.add(fault.look(board));
  }
}

int run(Options options) {
  const test::TemporaryFolder sockets;
  options.emulator.sockets = sockets.path();
  std::error_code error;
  std::filesystem::create_directories(options.emulator.out, error);
  const auto scene = host_sim::load_scenario(options.scenario);
  if (!scene) return complain(scene.error(), kWrongUse);
  options.emulator.cameras = scene->cameras.size();
  auto board = Board::power_on(*scene, options.emulator);
  if (!board) return complain(board.error(), kFailed);
  Report report(options.emulator.out / "report.json");
  look_at(**board, options, report);
  fmt::print("{}\n", report.all_hold() ? "all of it holds" : "NOT all of it holds");
  return report.all_hold() ? kDone : kFailed;
}

int make_rig(const Options& options) {
  const auto scene = host_sim::load_scenario(options.scenario);
  if (!scene) return complain(scene.error(), kWrongUse);
  const auto written = write_unit_rig(*scene, options.folder);
  return written ? kDone : complain(written.error(), kFailed);
}

void add_run(CLI::App& app, Options& options) {
  EmulatorSetup& emulator = options.emulator;
  app.add_option("scenario", options.scenario)->required()->check(CLI::ExistingFile);
  app.add_option("--image", emulator.image, "disk image that the board boots; stays as it is")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--observer", emulator.observer, "disk with what only the test needs")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--firmware", emulator.firmware, "UEFI's code")->required();
  app.add_option("--variables", emulator.variables, "what UEFI remembers; is written")->required();
  app.add_option("--out", emulator.out, "folder of the report and the logs")->required();
  app.add_option("--poses", options.poses, "how many before the faults")->capture_default_str();
  app.add_option("--only", options.only,
                 "these faults: camera can rig exposure light disk hang end measure tests")
      ->delimiter(',');
}

int main_of(int argc, char** argv) {
  CLI::App app{"dottrack on a virtual board"};
  app.require_subcommand(1);
  Options options;
  CLI::App* rig = app.add_subcommand("rig", "write rig.toml, camera models and target");
  rig->add_option("scenario", options.scenario)->required()->check(CLI::ExistingFile);
  rig->add_option("folder", options.folder)->required();
  add_run(*app.add_subcommand("run", "boot the image and look at what it does"), options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUse;
  }
  return rig->parsed() ? make_rig(options) : run(options);
}

}  // namespace
}  // namespace dottrack::board

int main(int argc, char** argv) {
  return dottrack::board::main_of(argc, argv);
}
