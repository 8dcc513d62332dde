#include "app/config/target_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "app/config/rig_file.h"
#include "app/config/rig_rules.h"
#include "app/config/table_reader.h"

namespace dottrack::config {
namespace {

constexpr std::string_view kExpected = "a table [target], or up to 8 tables [[target]]";
static_assert(kMaxTargets == 8);

class TargetsReader {
 public:
  TargetsReader(Complaint& complaint, std::string title)
      : complaint_(complaint), title_(std::move(title)) {}

  void read(const toml::table& table) {
    TableReader reader(complaint_, table, title_,
                       {"name", "dots", "upright", "max_step_m", "dot_sigma_m", "allow_ambiguous"});
    NamedTarget target;
    target.name = reader.text("name", "target");
    check_name(reader, target.name);
    target.dots = reader.text("dots");
    target.dots_line = reader.line("dots");
    target.target.upright = reader.boolean("upright", true);
    target.allow_ambiguous = reader.boolean("allow_ambiguous", false);
    target.target.max_step_m = reader.number("max_step_m", 0.2, kStep);
    target.target.dot_sigma_m = reader.number("dot_sigma_m", 0.0, kDotSigma);
    name_lines_.push_back(reader.line("name"));
    targets_.push_back(std::move(target));
  }

  std::vector<NamedTarget> take() { return std::move(targets_); }

 private:
  void check_name(TableReader& reader, const std::string& name) {
    const auto same = std::find_if(targets_.begin(), targets_.end(),
                                   [&](const NamedTarget& other) { return other.name == name; });
    if (same == targets_.end()) return;
    const auto earlier = name_lines_[static_cast<std::size_t>(same - targets_.begin())];
    reader.complain("name", fmt::format("{} again, first on line {}", in_quotes(name), earlier),
                    "a name of its own for every target");
  }

  Complaint& complaint_;
  std::string title_;
  std::vector<NamedTarget> targets_;
  std::vector<std::size_t> name_lines_;
};

}  // namespace

std::vector<NamedTarget> read_targets(Complaint& complaint, const toml::table& root) {
  const toml::node* node = root.get("target");
  if (node == nullptr) {
    complaint.add(1, "no table [target]", kExpected);
    return {};
  }
  const std::size_t line = root.find("target")->first.source().begin.line;
  if (const toml::table* table = node->as_table()) {
    TargetsReader reader(complaint, "[target]");
    reader.read(*table);
    return reader.take();
  }
  const toml::array* list = node->as_array();
  if (list == nullptr || !list->is_array_of_tables()) {
    complaint.add(line, fmt::format("target is {}", kind_of(*node)), kExpected);
    return {};
  }
  if (list->size() > kMaxTargets) {
    complaint.add(list->get(kMaxTargets)->source().begin.line,
                  fmt::format("{} targets", list->size()), kExpected);
  }
  TargetsReader reader(complaint, "[[target]]");
  for (const toml::node& element : *list) reader.read(*element.as_table());
  return reader.take();
}

}  // namespace dottrack::config
