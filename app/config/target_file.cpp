#include "app/config/target_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "app/config/complaint.h"
#include "app/config/target_shape.h"
#include "app/config/text_file.h"

namespace dottrack::config {
namespace {

constexpr std::string_view kHeader = "dot,x_m,y_m,z_m,diameter_m";
constexpr std::string_view kHeaderWithNormals = "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz";
constexpr std::size_t kFields = 5;
constexpr std::size_t kFieldsWithNormals = 8;
constexpr double kLargestCoordinate_m = 100.0;
constexpr double kLargestDiameter_m = 10.0;
constexpr double kUnitTolerance = 1e-3;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

class TargetParser {
 public:
  explicit TargetParser(const std::string& name) : complaint_(name) {}

  Result<TargetFile> parse(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty() && complaint_.empty()) {
      const auto end = text.find('\n');
      ++line_;
      read_line(trimmed(text.substr(0, end)));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    check_target();
    if (!complaint_.empty()) return tl::unexpected<Error>(complaint_.first());
    return TargetFile{dots_, std::move(ids_), std::move(lines_)};
  }

 private:
  void read_line(std::string_view line) {
    if (line.empty() || line.front() == '#') return;
    if (fields_ == 0) {
      read_header(line);
    } else {
      read_dot(split(line));
    }
  }

  void read_header(std::string_view line) {
    std::string header;
    for (const std::string_view field : split(line)) header += fmt::format("{},", field);
    header.pop_back();
    if (header == kHeader) {
      fields_ = kFields;
    } else if (header == kHeaderWithNormals) {
      fields_ = kFieldsWithNormals;
    } else {
      complain("header " + in_quotes(line), fmt::format("{} or {}", kHeader, kHeaderWithNormals));
    }
  }

  void read_dot(const std::vector<std::string_view>& fields) {
    if (fields.size() != fields_) {
      return complain(fmt::format("{} fields", fields.size()),
                      fmt::format("{} as in the header", fields_));
    }
    if (dots_.size() == core::kMaxDots) return complain("more than 16 dots", "3 to 16 dots");
    read_id(fields[0]);
    core::TargetDot dot;
    dot.position_m.x() = read_coordinate(fields[1], "x_m");
    dot.position_m.y() = read_coordinate(fields[2], "y_m");
    dot.position_m.z() = read_coordinate(fields[3], "z_m");
    dot.diameter_m = read_diameter(fields[4]);
    if (fields_ == kFieldsWithNormals) dot.normal = read_normal(fields);
    dots_.push_back(dot);
    lines_.push_back(line_);
  }

  void read_id(std::string_view id) {
    if (id.empty()) complain("a dot without a name in column dot", "a name or a number");
    const auto same = std::find(ids_.begin(), ids_.end(), id);
    if (same != ids_.end()) {
      const auto earlier = lines_[static_cast<std::size_t>(same - ids_.begin())];
      complain(fmt::format("dot {} again, first on line {}", in_quotes(id), earlier),
               "every dot once");
    }
    ids_.emplace_back(id);
  }

  // NaN and infinities are numbers to the parser, but no place and no size.
  double read_number(std::string_view field, std::string_view column, std::string_view expected) {
    const std::string_view digits = field.starts_with('+') ? field.substr(1) : field;
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.begin(), digits.end(), value);
    if (error == std::errc() && end == digits.end() && std::isfinite(value)) return value;
    complain(fmt::format("{} is {}", column, in_quotes(field)), expected);
    return 0.0;
  }

  double read_coordinate(std::string_view field, std::string_view column) {
    constexpr std::string_view kExpected = "a number of metres from -100 to 100";
    const double value_m = read_number(field, column, kExpected);
    if (std::abs(value_m) > kLargestCoordinate_m) {
      complain(fmt::format("{} is {}", column, field), kExpected);
    }
    return value_m;
  }

  double read_diameter(std::string_view field) {
    constexpr std::string_view kExpected = "a number of metres above 0 and up to 10";
    const double value_m = read_number(field, "diameter_m", kExpected);
    if (!(value_m > 0.0 && value_m <= kLargestDiameter_m)) {
      complain(fmt::format("diameter_m is {}", field), kExpected);
    }
    return value_m;
  }

  std::optional<Eigen::Vector3d> read_normal(const std::vector<std::string_view>& fields) {
    if (fields[5].empty() && fields[6].empty() && fields[7].empty()) return std::nullopt;
    constexpr std::string_view kExpected = "a number: the normal is a unit vector, or left empty";
    Eigen::Vector3d normal;
    normal.x() = read_number(fields[5], "nx", kExpected);
    normal.y() = read_number(fields[6], "ny", kExpected);
    normal.z() = read_number(fields[7], "nz", kExpected);
    const double length = normal.norm();
    if (!(std::abs(length - 1.0) <= kUnitTolerance)) {
      complain(fmt::format("nx,ny,nz is a vector of length {:.4g}", length),
               "a unit vector, within 0.001");
      return std::nullopt;
    }
    return normal / length;
  }

  void check_target() {
    if (fields_ == 0) return complaint_.add(0, "no header line", kHeader);
    if (dots_.size() < core::kMinDots) {
      return complain(fmt::format("{} dots", dots_.size()), "3 to 16 dots");
    }
    if (!complaint_.empty()) return;
    if (const auto fault = find_shape_fault({dots_.data(), dots_.size()}, ids_)) {
      complaint_.add(lines_[fault->dot], fault->what, fault->expected);
    }
  }

  void complain(std::string_view what, std::string_view expected) {
    complaint_.add(line_, what, expected);
  }

  Complaint complaint_;
  std::size_t line_ = 0;
  std::size_t fields_ = 0;  // a line; 0 before the header
  TargetDots dots_;
  std::vector<std::string> ids_;
  std::vector<std::size_t> lines_;  // where each dot stands
};

}  // namespace

Result<TargetFile> parse_target_text(const std::string& text, const std::string& name) {
  return TargetParser(name).parse(text);
}

Result<TargetFile> read_target_file(const std::filesystem::path& path) {
  const Result<std::string> text = read_text_file(path);
  if (!text) {
    Complaint complaint(path.string());
    complaint.add(0, text.error().message, "a target file with the header " + std::string(kHeader));
    return tl::unexpected<Error>(complaint.first());
  }
  return parse_target_text(*text, path.string());
}

}  // namespace dottrack::config
