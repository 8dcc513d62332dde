// Where the built-in scenarios are.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include "host_sim/scenarios/scenario_file.h"

namespace dottrack::host_sim {
namespace {

namespace fs = std::filesystem;

// The first that exists counts: beside the sources of a build, or where an installation has them.
constexpr std::array kFolders = {DOTTRACK_SCENARIO_SOURCES, DOTTRACK_SCENARIO_INSTALLED};

fs::path built_in_folder() {
  std::error_code ignored;
  for (const char* folder : kFolders) {
    if (fs::is_directory(folder, ignored)) return folder;
  }
  return {};
}

std::vector<std::string> built_in_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Result<fs::path> find_scenario(const std::string& name_or_path) {
  std::error_code ignored;
  if (fs::is_regular_file(name_or_path, ignored)) return fs::path(name_or_path);
  const fs::path folder = built_in_folder();
  const std::vector<std::string> names = built_in_names(folder);
  if (std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return folder / (name_or_path + ".toml");
  }
  return fail(fmt::format("{}: no such scenario; expected a file or one of {}", name_or_path,
                          fmt::join(names, ", ")));
}

}  // namespace dottrack::host_sim
