// [light] and [[light_change]].

#include <algorithm>
#include <array>

#include "host_sim/scenarios/scenario_reader.h"

namespace dottrack::host_sim {
namespace {

constexpr NumberRule kLevel{0.0, 10.0, "a level from 0 (off) to 10", true};

struct Group {
  std::string_view name;
  double level;
};
// What burns at the start where the file does not say.
constexpr std::array<Group, 3> kGroups = {{{"fluorescent", 1.0}, {"window", 0.5}, {"sun", 0.0}}};

// What can be switched together, by the beginnings of the lamps' groups.
constexpr std::array<std::string_view, 5> kSwitches = {"fluorescent", "fluorescent_west",
                                                       "fluorescent_east", "window", "sun"};

}  // namespace

LightPlan read_light(Complaint& complaint, const toml::table* levels,
                     const std::vector<const toml::table*>& changes) {
  LightPlan plan;
  static const toml::table kNothing;
  TableReader start(complaint, levels != nullptr ? *levels : kNothing, "[light]",
                    {"fluorescent", "window", "sun"});
  for (const Group& group : kGroups) {
    plan.changes.push_back(
        {std::string(group.name), 0.0, start.number(group.name, group.level, kLevel), 0.0});
  }
  for (const toml::table* table : changes) {
    TableReader reader(complaint, *table, "[[light_change]]", {"group", "at_s", "to", "over_s"});
    LightChange change;
    change.group = kSwitches[reader.choice("group", kSwitches)];
    change.at_s = reader.number("at_s", std::nullopt, kSeconds);
    change.to = reader.number("to", std::nullopt, kLevel);
    change.over_s = reader.number("over_s", 0.0, kSeconds);
    plan.changes.push_back(std::move(change));
  }
  std::stable_sort(plan.changes.begin(), plan.changes.end(),
                   [](const LightChange& a, const LightChange& b) { return a.at_s < b.at_s; });
  return plan;
}

}  // namespace dottrack::host_sim
