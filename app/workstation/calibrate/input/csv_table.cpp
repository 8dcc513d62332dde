#include "app/workstation/calibrate/input/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "app/config/text_file.h"

namespace dottrack::calibrate {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

Result<CsvTable> CsvTable::read(const std::filesystem::path& path, const std::string& expected) {
  const auto text = config::read_text_file(path);
  if (!text) {
    return fail(fmt::format("{}: {}; expected a table with the headings {}", path.string(),
                            text.error().message, expected));
  }
  CsvTable table(path.string());
  table.parse(*text, expected);
  if (!table.complaint_.empty()) return tl::unexpected<Error>(table.complaint_.first());
  return table;
}

void CsvTable::parse(std::string_view text, const std::string& expected) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  for (std::size_t line = 1; !text.empty() && complaint_.empty(); ++line) {
    const auto end = text.find('\n');
    const std::string_view content = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (content.empty() || content.front() == '#') continue;
    std::vector<std::string> fields = split(content);
    if (headings_.empty()) {
      for (const std::string& field : fields) headings_.push_back(lower(field));
    } else if (fields.size() != headings_.size()) {
      complaint_.add(line, fmt::format("{} fields", fields.size()),
                     fmt::format("{} as in the headings", headings_.size()));
    } else {
      rows_.push_back(std::move(fields));
      lines_.push_back(line);
    }
  }
  if (rows_.empty()) complaint_.add(0, "nothing in it", "a table with the headings " + expected);
}

std::optional<std::size_t> CsvTable::column(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    const auto found = std::find(headings_.begin(), headings_.end(), name);
    if (found != headings_.end()) return static_cast<std::size_t>(found - headings_.begin());
  }
  return std::nullopt;
}

std::optional<CsvTable::Length> CsvTable::length(std::string_view name) const {
  struct Unit {
    std::string_view suffix;
    double metres;
  };
  constexpr std::array kUnits{Unit{"_m", 1.0}, Unit{"_cm", 0.01}, Unit{"_mm", 0.001},
                              Unit{"[m]", 1.0}, Unit{"[mm]", 0.001}};
  for (const Unit& unit : kUnits) {
    if (const auto found = column({std::string(name) + std::string(unit.suffix)})) {
      return Length{*found, unit.metres};
    }
  }
  return std::nullopt;
}

double CsvTable::number(std::size_t row, std::size_t column) {
  const std::string& field = rows_[row][column];
  const std::string_view digits =
      field.starts_with('+') ? std::string_view(field).substr(1) : std::string_view(field);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value);
  if (error == std::errc() && end == digits.end() && std::isfinite(value)) return value;
  complain(row, fmt::format("{} is {}", headings_[column], config::in_quotes(field)), "a number");
  return 0.0;
}

std::size_t CsvTable::whole_number(std::size_t row, std::size_t column) {
  const std::string& field = rows_[row][column];
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc() && end == field.data() + field.size()) return value;
  complain(row, fmt::format("{} is {}", headings_[column], config::in_quotes(field)),
           "a whole number");
  return 0;
}

}  // namespace dottrack::calibrate
