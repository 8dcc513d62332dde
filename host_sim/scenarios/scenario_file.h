#pragma once
// Scenario files: TOML in, a scene out. docs/scenarios.md says what is in them.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

// What a command line may say instead of the file.
struct ScenarioOverrides {
  std::optional<std::uint64_t> seed = std::nullopt;
  std::optional<std::uint64_t> ticks = std::nullopt;
  std::optional<std::uint64_t> layout_seed = std::nullopt;  // of [vehicle]
};

inline constexpr std::uint64_t kMaxTicks = 1'000'000;  // as many as the frames' names can count

// The first thing that is wrong is one line, `file:line: what; expected what`. The same file and
// seed give the same scene on every machine.
Result<Scene> load_scenario(const std::filesystem::path& file,
                            const ScenarioOverrides& overrides = {});

// The same from text; `name` stands for the file in messages.
Result<Scene> parse_scenario(const std::string& text, const std::string& name,
                             const ScenarioOverrides& overrides = {});

// A path if there is such a file, else the built-in scenario of that name (without .toml). The
// error lists the built-in ones.
Result<std::filesystem::path> find_scenario(const std::string& name_or_path);

}  // namespace dottrack::host_sim
