#include "tests/unit/architecture/rules.h"

#include <algorithm>
#include <array>
#include <regex>
#include <string_view>

namespace dottrack::architecture {
namespace {

using Names = std::vector<std::string_view>;

struct Rule {
  std::string_view folder;  // the rule of the longest folder that holds a file counts
  Names project;            // folders or headers of the project that it may include
  Names libraries;          // what it may include beyond the C++ standard library; * is anything
};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> kRules{
      {"hal/base", {"hal/base"}, {"tl/expected.hpp", "boost/container/static_vector.hpp"}},
      {"hal", {"hal"}, {}},

      {"rtos_shim", {"rtos_shim", "hal/base"}, {"boost/lockfree"}},
      {"rtos_shim/posix_rt", {"rtos_shim", "hal/base"}, {"*"}},
      {"rtos_shim/allocation_trap", {"rtos_shim"}, {"*"}},
      {"rtos_shim/virtual_time", {"rtos_shim", "hal/base"}, {}},

      // A driver knows no other driver.
      {"drivers/recorded", {"drivers/recorded", "hal", "rtos_shim"}, {"fmt"}},
      {"drivers/candump", {"drivers/candump", "hal", "rtos_shim"}, {"fmt"}},
      {"drivers/libcamera", {"drivers/libcamera", "hal", "rtos_shim"}, {"*"}},
      {"drivers/libgpiod", {"drivers/libgpiod", "hal", "rtos_shim"}, {"*"}},
      {"drivers/socketcan", {"drivers/socketcan", "hal", "rtos_shim"}, {"*"}},

      {"app/core", {"app/core", "hal/base"}, {"Eigen", "hwy"}},
      {"app/core/geometry", {"app/core/geometry", "hal/base"}, {"Eigen", "hwy"}},
      // Two C files that are copied into other programs.
      {"app/core/protocol/receiver", {}, {"stdbool.h", "stddef.h", "stdint.h"}},

      {"app/config",
       {"app/config", "app/core", "hal", "rtos_shim"},
       {"Eigen", "boost/crc.hpp", "fmt", "toml++"}},
      {"app/telemetry",
       {"app/telemetry", "app/core", "hal", "rtos_shim"},
       {"Eigen", "boost", "fmt"}},
      {"app/cycle", {"app/cycle", "app/telemetry", "app/core", "hal", "rtos_shim"}, {"Eigen"}},
      {"app/firmware", {"app", "drivers", "hal", "rtos_shim"}, {"*"}},
      {"app/workstation", {"app", "drivers", "hal", "rtos_shim", "host_sim"}, {"*"}},

      // Not app/core/geometry: an error in a shared camera model would cancel out. Of app/config
      // only what reads any TOML.
      {"host_sim",
       {"host_sim", "hal", "rtos_shim", "app/core/protocol", "app/config/complaint.h",
        "app/config/rig_rules.h", "app/config/table_reader.h", "app/config/text_file.h"},
       {"Eigen", "fmt", "embree3", "toml++"}},
      {"host_sim/usb_cameras",
       {"host_sim", "hal", "rtos_shim"},
       {"fmt", "poll.h", "sys", "unistd.h", "usbredirparser.h"}},

      {"tests", {"app", "drivers", "hal", "host_sim", "rtos_shim", "tests"}, {"*"}},
  };
  return kRules;
}

bool inside(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

const Rule* rule_of(std::string_view path) {
  const Rule* best = nullptr;
  for (const Rule& rule : rules()) {
    const bool closer = best == nullptr || rule.folder.size() > best->folder.size();
    if (closer && inside(path, rule.folder)) best = &rule;
  }
  return best;
}

// A backend is private to whoever assembles a program: interfaces only, for all others.
bool is_backend(std::string_view include) {
  return inside(include, "rtos_shim/posix_rt") || inside(include, "rtos_shim/virtual_time");
}

bool may_use_backends(std::string_view folder) {
  constexpr std::array kAssemblers{
      "app/firmware",       "app/workstation",       "tests", "host_sim", "host_sim/usb_cameras",
      "rtos_shim/posix_rt", "rtos_shim/virtual_time"};
  return std::find(kAssemblers.begin(), kAssemblers.end(), folder) != kAssemblers.end();
}

bool is_standard(std::string_view include) {
  return include.find('/') == std::string_view::npos && !include.ends_with(".h") &&
         !include.ends_with(".hpp");
}

bool listed(const Names& names, std::string_view include) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return name == "*" || inside(include, name); });
}

bool allowed(const Rule& rule, const Include& include) {
  if (include.angled) return is_standard(include.path) || listed(rule.libraries, include.path);
  if (is_backend(include.path) && !may_use_backends(rule.folder)) return false;
  return listed(rule.project, include.path);
}

std::string at_line(const SourceFile& file, std::size_t line, const std::string& what) {
  return file.path + ":" + std::to_string(line) + ": " + what;
}

struct Impurity {
  std::string_view name;
  std::regex pattern;
};

const std::vector<Impurity>& core_impurities() {
  static const std::vector<Impurity> kImpurities{
      {"a clock", std::regex(R"(\b(\w+_clock|clock_gettime|gettimeofday|now\s*\(\s*\)))")},
      {"a thread",
       std::regex(
           R"(\bstd::(j?thread|mutex|\w+_mutex|condition_variable|async|future)\b|\bthread_local\b)")},
      {"a file", std::regex(R"(\b(fopen|std::[io]?fstream|std::filesystem)\b)")},
      {"a stream",
       std::regex(R"(\bstd::(cout|cerr|clog|[io]?stringstream|[io]stream)\b|\bf?printf\s*\()")},
      {"the heap", std::regex(R"(\bnew\b|\bdelete\s|\b(malloc|calloc|realloc|free)\s*\()")},
      {"a container that allocates",
       std::regex(
           R"(\bstd::(vector|string|deque|list|map|set|multi\w+|unordered_\w+|function|any)\b)")},
      {"a matrix that allocates",
       std::regex(R"(\bEigen::(MatrixX\w*|VectorX\w*|RowVectorX\w*|ArrayX\w*|Dynamic)\b)")},
      {"an exception", std::regex(R"(\bthrow\b|\btry\b|\bcatch\b)")},
  };
  return kImpurities;
}

constexpr std::array kImpureHeaders{
    "cstdio",  "ctime",  "fstream", "filesystem",         "iostream", "sstream",      "ostream",
    "istream", "thread", "mutex",   "condition_variable", "future",   "shared_mutex", "semaphore",
    "vector",  "string", "map",     "unordered_map",      "set",      "deque",        "list"};

void check_headers(const SourceFile& file, Violations& violations) {
  for (const Include& include : includes_of(file.text)) {
    const bool impure = std::find(kImpureHeaders.begin(), kImpureHeaders.end(), include.path) !=
                        kImpureHeaders.end();
    if (impure) {
      violations.push_back(at_line(file, include.line, "the core includes <" + include.path + ">"));
    }
  }
}

void check_words(const SourceFile& file, Violations& violations) {
  const std::string code = code_only(file.text);
  for (const Impurity& impurity : core_impurities()) {
    std::smatch match;
    if (!std::regex_search(code, match, impurity.pattern)) continue;
    const auto before =
        std::string_view(code).substr(0, static_cast<std::size_t>(match.position()));
    const auto line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    violations.push_back(
        at_line(file, line, "the core uses " + std::string(impurity.name) + ": " + match.str()));
  }
}

}  // namespace

Violations forbidden_includes(const SourceFile& file) {
  const Rule* rule = rule_of(file.path);
  if (rule == nullptr) return {at_line(file, 1, "no rule says what this folder may include")};
  Violations violations;
  for (const Include& include : includes_of(file.text)) {
    if (allowed(*rule, include)) continue;
    violations.push_back(at_line(file, include.line,
                                 std::string(rule->folder) + " may not include " + include.path));
  }
  return violations;
}

Violations impurities(const SourceFile& file) {
  Violations violations;
  if (!inside(file.path, "app/core")) return violations;
  check_headers(file, violations);
  check_words(file, violations);
  return violations;
}

}  // namespace dottrack::architecture
