#include "app/workstation/survey/run_file.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

class Columns {
 public:
  Columns(std::string file, const std::string& header) : file_(std::move(file)) {
    for (const std::string_view name : fields_of(header)) {
      index_.emplace(std::string(name), index_.size());
    }
  }

  std::size_t operator[](const std::string& name) {
    const auto found = index_.find(name);
    if (found != index_.end()) return found->second;
    if (missing_.empty()) missing_ = name;
    return 0;
  }

  std::size_t size() const { return index_.size(); }
  Result<void> check() const {
    if (missing_.empty()) return {};
    return fail(fmt::format("{}:1: no column {}; expected poses.csv of a run of this rig", file_,
                            missing_));
  }

 private:
  std::string file_;
  std::unordered_map<std::string, std::size_t> index_;
  std::string missing_;
};

struct ViewColumns {
  std::size_t camera;
  std::size_t dot;
  std::size_t x;
  std::size_t y;
  std::size_t moved;
};

// Where in a line everything stands.
struct Layout {
  std::size_t tick = 0;
  std::vector<std::size_t> pose;
  std::vector<ViewColumns> views;
};

Layout layout_of(Columns& columns, const config::RigConfig& rig) {
  Layout layout;
  layout.tick = columns["tick"];
  for (const char* name : {"x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"}) {
    layout.pose.push_back(columns[name]);
  }
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const std::string& camera = rig.cameras[c].name;
    const std::size_t moved = columns[camera + "_moved"];
    for (std::size_t dot = 0; dot < rig.rig.target.dots.size(); ++dot) {
      const std::string view = fmt::format("dot{}_{}", dot, camera);
      layout.views.push_back({c, dot, columns[view + "_x_px"], columns[view + "_y_px"], moved});
    }
  }
  return layout;
}

class LineReader {
 public:
  explicit LineReader(const std::vector<std::string_view>& fields) : fields_(fields) {}

  bool has(std::size_t column) const { return !fields_[column].empty(); }
  double number(std::size_t column) {
    const std::string_view text = fields_[column];
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) wrong_ = true;
    return value;
  }
  bool wrong() const { return wrong_; }

 private:
  const std::vector<std::string_view>& fields_;
  bool wrong_ = false;
};

RecordedTick tick_of(LineReader& line, const Layout& layout) {
  RecordedTick tick;
  tick.tick = static_cast<std::uint64_t>(line.number(layout.tick));
  double p[7];
  for (std::size_t i = 0; i < 7; ++i) p[i] = line.number(layout.pose[i]);
  tick.pose.position_m = {p[0], p[1], p[2]};
  tick.pose.orientation = Eigen::Quaterniond(p[6], p[3], p[4], p[5]).normalized();
  for (const ViewColumns& view : layout.views) {
    if (!line.has(view.x)) continue;
    tick.views.push_back({view.camera,
                          view.dot,
                          {line.number(view.x), line.number(view.y)},
                          line.number(view.moved) != 0.0});
  }
  return tick;
}

}  // namespace

Result<std::vector<RecordedTick>> read_run(const fs::path& run, const config::RigConfig& rig) {
  const fs::path file = fs::is_directory(run) ? run / "poses.csv" : run;
  std::ifstream in(file);
  std::string text;
  if (!in || !std::getline(in, text)) {
    return fail(fmt::format("{}: cannot be read; expected poses.csv of a run", file.string()));
  }
  Columns columns(file.string(), text);
  const Layout layout = layout_of(columns, rig);
  if (auto good = columns.check(); !good) return tl::unexpected<Error>(good.error());
  std::vector<RecordedTick> ticks;
  for (std::size_t number = 2; std::getline(in, text); ++number) {
    const auto fields = fields_of(text);
    LineReader line(fields);
    if (fields.size() == columns.size()) {
      if (!line.has(layout.pose[0])) continue;
      ticks.push_back(tick_of(line, layout));
    }
    if (fields.size() == columns.size() && !line.wrong()) continue;
    return fail(fmt::format("{}:{}: not a line of poses.csv; expected {} numbers and words",
                            file.string(), number, columns.size()));
  }
  return ticks;
}

}  // namespace dottrack::workstation
