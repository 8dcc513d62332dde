#include "drivers/recorded/frame_times.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <string_view>
#include <system_error>

namespace dottrack::drivers {
namespace {

constexpr std::string_view kHeader = "tick,camera,mid_exposure_ns,arrival_ns";

// The four fields of a line; nothing when there are more or fewer.
std::optional<std::array<std::string_view, 4>> split(std::string_view line) {
  std::array<std::string_view, 4> fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto comma = line.find(',');
    if ((comma == std::string_view::npos) != (i == fields.size() - 1)) return std::nullopt;
    fields[i] = line.substr(0, comma);
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  return fields;
}

std::optional<std::int64_t> whole_number(std::string_view field) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || value < 0) return std::nullopt;
  return value;
}

struct Row {
  std::uint64_t tick = 0;
  std::string camera;
  FrameTimes times;
};

std::optional<Row> row_of(std::string_view line) {
  const auto fields = split(line);
  if (!fields) return std::nullopt;
  const auto tick = whole_number((*fields)[0]);
  const auto mid_exposure = whole_number((*fields)[2]);
  const auto arrival = whole_number((*fields)[3]);
  if (!tick || (*fields)[1].empty() || !mid_exposure || !arrival) return std::nullopt;
  if (*arrival < *mid_exposure) return std::nullopt;
  return Row{static_cast<std::uint64_t>(*tick),
             std::string((*fields)[1]),
             {Time(Duration(*mid_exposure)), Time(Duration(*arrival))}};
}

}  // namespace

Result<FrameTimesTable> FrameTimesTable::read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  FrameTimesTable table;
  std::string line;
  std::size_t number = 0;
  const auto wrong = [&](std::string_view what, std::string_view expected) {
    return fail(fmt::format("{}:{}: {}; expected {}", file.string(), number, what, expected));
  };
  while (std::getline(in, line)) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      if (line != kHeader) return wrong("another header", kHeader);
      continue;
    }
    if (line.empty()) continue;
    const auto row = row_of(line);
    if (!row) {
      return wrong("no frame's times",
                   "tick,camera,mid_exposure_ns,arrival_ns, whole numbers, "
                   "the arrival not before the exposure");
    }
    if (!table.times_.emplace(std::pair(row->tick, row->camera), row->times).second) {
      return wrong(fmt::format("tick {} of {} again", row->tick, row->camera), "every frame once");
    }
  }
  if (in.bad() || number == 0) {
    return fail(fmt::format("{} cannot be read; expected {}", file.string(), kHeader));
  }
  return table;
}

std::optional<FrameTimes> FrameTimesTable::find(std::uint64_t tick,
                                                const std::string& camera) const {
  const auto found = times_.find({tick, camera});
  if (found == times_.end()) return std::nullopt;
  return found->second;
}

}  // namespace dottrack::drivers
