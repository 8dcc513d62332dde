#include "app/workstation/acquisitions_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"
#include "app/workstation/trial_summary.h"

namespace dottrack::workstation {
namespace {

int run(const std::vector<std::string>& files) {
  std::vector<Trial> all;
  for (const std::string& file : files) {
    std::ifstream in(file);
    if (!in) return complain(fmt::format("{}: cannot be read; expected an acquisitions.csv", file));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto trials = trials_from_csv(text);
    if (!trials) return complain(fmt::format("{}: {}", file, trials.error().message));
    all.insert(all.end(), trials->begin(), trials->end());
  }
  if (const auto once = check_once(all); !once) return complain(once.error().message);
  if (all.empty()) return complain("no placement in any file; expected lines of acquisitions.csv");
  fmt::print("{}", summary_text(all));
  return good(all) ? kDone : kFailed;
}

}  // namespace

void add_acquisitions_command(CLI::App& app, int& exit_status) {
  CLI::App* const command = app.add_subcommand(
      "acquisitions", "Sum up acquisitions.csv files of `dottrack sim --acquisitions`.");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("files", *files, "The files: pieces of one run, or several runs")->required();
  command->callback([files, &exit_status] { exit_status = run(*files); });
}

}  // namespace dottrack::workstation
