// Camera files from text to model: every value is checked, none is repaired.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/config/camera_file.h"
#include "app/config/camera_internal.h"
#include "app/config/camera_lines.h"
#include "app/config/complaint.h"

namespace dottrack::config {
namespace {

constexpr double kUnitTolerance = 1e-3;  // published axes carry six digits
constexpr int kMostPixels = 1000000;     // a side of an image
// How far Hs, Hc, Vs, Vc and Theta may be from what A, H and V say. They are written with nine
// decimals at most and may have been worked out from a normalised A.
constexpr double kInternalTolerance_px = 0.1;
constexpr double kInternalTolerance = 1e-3;  // of the number and the scale
constexpr double kThetaTolerance_rad = 1e-3;
constexpr double kSymmetryTolerance = 1e-6;  // of the larger of two mirrored elements

constexpr std::array<std::string_view, 7> kVectors = {"C", "A", "H", "V", "O", "R", "E"};

enum class Kind { cahv, cahvor, cahvore };

std::string_view name_of(Kind kind) {
  if (kind == Kind::cahv) return "CAHV";
  return kind == Kind::cahvor ? "CAHVOR" : "CAHVORE";
}

// The Model line.
struct Declared {
  Kind kind = Kind::cahv;
  double linearity = 1.0;
};

std::vector<std::string_view> words(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> found;
  for (;;) {
    const auto first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return found;
    text.remove_prefix(first);
    const auto end = std::min(text.find_first_of(kBlanks), text.size());
    found.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

// A finite decimal number and nothing else.
template <class Number>
std::optional<Number> to_number(std::string_view word) {
  const bool plus = word.starts_with('+') && !word.starts_with("+-");
  const std::string_view digits = plus ? word.substr(1) : word;
  Number value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  if (!std::isfinite(static_cast<double>(value))) return std::nullopt;
  return value;
}

class CameraParser {
 public:
  explicit CameraParser(const std::string& name) : complaint_(name) {}

  Result<CameraFile> parse(std::string_view text) {
    lines_ = split_camera_text(text, complaint_);
    CameraFile file;
    if (complaint_.empty()) read(file);
    if (!complaint_.empty()) return tl::unexpected<Error>(complaint_.first());
    return file;
  }

 private:
  void read(CameraFile& file) {
    file.comment = lines_.comment;
    const Declared declared = read_declared();
    for (const std::string_view key : kVectors) {
      if (lines_.find(key) != nullptr) read_vector(key);
    }
    if (complaint_.empty()) require_keys(declared.kind);
    file.dimensions = read_dimensions();
    if (complaint_.empty()) file.model = read_model(declared);
    if (complaint_.empty()) check_linear_part(linear_part(file.model));
    const int vectors = declared.kind == Kind::cahv ? 4 : declared.kind == Kind::cahvor ? 6 : 7;
    file.covariance = read_covariance("S", 3 * vectors, name_of(declared.kind));
    read_covariance("S internal", 5, "Hs, Hc, Vs, Vc, Theta");
  }

  // What the Model line says; without one, what the keys tell.
  Declared read_declared() {
    if (const CameraItem* model = lines_.find("Model")) return read_model_line(*model);
    if (const CameraItem* e = lines_.find("E")) {
      complaint_.add(e->line, "key E, but no Model line that says which kind of CAHVORE",
                     "a line Model = CAHVORE1, CAHVORE2 or CAHVORE3,P");
    }
    const bool distorts = lines_.find("O") != nullptr || lines_.find("R") != nullptr;
    return {distorts ? Kind::cahvor : Kind::cahv, 1.0};
  }

  Declared read_model_line(const CameraItem& item) {
    const std::string_view value = item.value;
    const std::string_view whole = trimmed_blanks(value.substr(0, value.find('=')));
    const auto comma = whole.find(',');
    const std::string_view type = trimmed_blanks(whole.substr(0, comma));
    if (type == "CAHVORE3") return {Kind::cahvore, read_linearity(item, whole, comma)};
    if (comma == std::string_view::npos) {
      if (type == "CAHV") return {Kind::cahv, 1.0};
      if (type == "CAHVOR") return {Kind::cahvor, 1.0};
      if (type == "CAHVORE1") return {Kind::cahvore, 1.0};
      if (type == "CAHVORE2") return {Kind::cahvore, 0.0};
    }
    complaint_.add(item.line, "Model is " + in_quotes(whole),
                   "CAHV, CAHVOR, CAHVORE1, CAHVORE2 or CAHVORE3,P with a number P");
    return {};
  }

  double read_linearity(const CameraItem& item, std::string_view whole, std::size_t comma) {
    const std::string_view word =
        comma == std::string_view::npos ? "" : trimmed_blanks(whole.substr(comma + 1));
    if (const auto value = to_number<double>(word)) return *value;
    complaint_.add(item.line, "Model is " + in_quotes(whole),
                   "CAHVORE3,P with the linearity P as a number, as in CAHVORE3,0.37");
    return 0.0;
  }

  void require_keys(Kind kind) {
    const std::size_t wanted = kind == Kind::cahv ? 4 : kind == Kind::cahvor ? 6 : 7;
    const CameraItem* model = lines_.find("Model");
    for (std::size_t i = 0; i < kVectors.size(); ++i) {
      const CameraItem* item = lines_.find(kVectors[i]);
      if (item == nullptr && i < wanted) {
        complaint_.add(model != nullptr ? model->line : lines_.last_line,
                       fmt::format("no key {} in a {} file", kVectors[i], name_of(kind)),
                       fmt::format("a line {} = with three numbers", kVectors[i]));
      } else if (item != nullptr && i >= wanted) {
        complaint_.add(
            item->line, fmt::format("key {} in a {} file", kVectors[i], name_of(kind)),
            fmt::format("only {}", fmt::join(kVectors.begin(), kVectors.begin() + wanted, ", ")));
      }
    }
  }

  std::optional<ImageSize> read_dimensions() {
    const CameraItem* item = lines_.find("Dimensions");
    if (item == nullptr) return std::nullopt;
    const auto parts = words(item->value);
    if (parts.size() == 2) {
      const auto columns = to_number<int>(parts[0]);
      const auto rows = to_number<int>(parts[1]);
      const auto fits = [](int side) { return side > 0 && side <= kMostPixels; };
      if (columns && rows && fits(*columns) && fits(*rows)) return ImageSize{*columns, *rows};
    }
    complaint_.add(item->line, "Dimensions are " + in_quotes(item->value),
                   "columns and rows, two whole numbers above 0");
    return std::nullopt;
  }

  geometry::CameraModel read_model(const Declared& declared) {
    const Eigen::Vector3d c = read_vector("C");
    const Eigen::Vector3d a = read_axis("A");
    const Eigen::Vector3d h = read_vector("H");
    const Eigen::Vector3d v = read_vector("V");
    if (declared.kind == Kind::cahv) return geometry::Cahv{c, a, h, v};
    const Eigen::Vector3d o = read_axis("O");
    const Eigen::Vector3d r = read_vector("R");
    if (declared.kind == Kind::cahvor) return geometry::Cahvor{c, a, h, v, o, r};
    return geometry::Cahvore{c, a, h, v, o, r, read_vector("E"), declared.linearity};
  }

  Eigen::Vector3d read_vector(std::string_view key) {
    const CameraItem& item = *lines_.find(key);
    const std::vector<double> values = read_numbers(item.line, key, item.value);
    if (values.size() == 3) return {values[0], values[1], values[2]};
    complaint_.add(item.line, fmt::format("{} has {} numbers", key, values.size()),
                   "three numbers");
    return Eigen::Vector3d::UnitZ();
  }

  // Taken as it stands: normalising would move every pixel.
  Eigen::Vector3d read_axis(std::string_view key) {
    Eigen::Vector3d axis = read_vector(key);
    if (!(std::abs(axis.norm() - 1.0) <= kUnitTolerance)) {
      complaint_.add(lines_.find(key)->line,
                     fmt::format("{} is a vector of length {:.6g}", key, axis.norm()),
                     "a unit vector, within 0.001");
    }
    return axis;
  }

  std::vector<double> read_numbers(std::size_t line, std::string_view key, std::string_view text) {
    std::vector<double> values;
    for (const std::string_view word : words(text)) {
      const auto value = to_number<double>(word);
      if (!value) complaint_.add(line, fmt::format("{} has {}", key, in_quotes(word)), "a number");
      values.push_back(value.value_or(0.0));
    }
    return values;
  }

  void check_linear_part(const geometry::Cahv& m) {
    const double volume = std::abs(m.v.cross(m.h).dot(m.a));
    if (!(volume > 1e-9 * m.h.norm() * m.v.norm())) {
      return complaint_.add(lines_.find("V")->line, "A, H and V lie in one plane",
                            "H and V that span an image");
    }
    const InternalModel internal = internal_model(m.a, m.h, m.v);
    check_internal("Hs", internal.hs, internal.hs);
    check_internal("Hc", internal.hc, internal.hs);
    check_internal("Vs", internal.vs, internal.vs);
    check_internal("Vc", internal.vc, internal.vs);
    check_theta(internal.theta);
  }

  void check_internal(std::string_view key, double implied, double scale) {
    const CameraItem* item = lines_.find(key);
    if (item == nullptr) return;
    const std::vector<double> values = read_numbers(item->line, key, item->value);
    const double tolerance =
        kInternalTolerance_px + kInternalTolerance * (scale + std::abs(implied));
    if (values.size() == 1 && std::abs(values[0] - implied) <= tolerance) return;
    complaint_.add(item->line, fmt::format("{} is {}", key, in_quotes(item->value)),
                   fmt::format("{:.6f}, as A, H and V say, within {:.3g}", implied, tolerance));
  }

  // Theta = -1.5708 (-90.0 deg), the degrees optional.
  void check_theta(double implied_rad) {
    const CameraItem* item = lines_.find("Theta");
    if (item == nullptr) return;
    const std::string_view text = item->value;
    const auto bracket = text.find('(');
    const auto radians = to_number<double>(trimmed_blanks(text.substr(0, bracket)));
    const auto off = [&](double angle_rad) {
      return std::abs(std::remainder(angle_rad - implied_rad, 2.0 * std::numbers::pi));
    };
    const bool close = radians && off(*radians) <= kThetaTolerance_rad;
    if (close &&
        (bracket == std::string_view::npos || is_degrees(text.substr(bracket), *radians))) {
      return;
    }
    complaint_.add(
        item->line, "Theta is " + in_quotes(text),
        fmt::format("{0:.9f} ({1:.6f} deg), as A, H and V say, within {2} rad", implied_rad,
                    implied_rad * 180.0 / std::numbers::pi, kThetaTolerance_rad));
  }

  static bool is_degrees(std::string_view text, double radians) {
    constexpr std::string_view kUnit = "deg)";
    if (!text.ends_with(kUnit)) return false;
    text.remove_prefix(1);
    text.remove_suffix(kUnit.size());
    const auto degrees = to_number<double>(trimmed_blanks(text));
    return degrees && std::abs(*degrees - radians * 180.0 / std::numbers::pi) <= 0.1;
  }

  std::optional<Eigen::MatrixXd> read_covariance(std::string_view key, int size,
                                                 std::string_view of_what) {
    const CameraItem* item = lines_.find(key);
    if (item == nullptr || !complaint_.empty()) return std::nullopt;
    const auto side = static_cast<std::size_t>(size);
    if (!item->value.empty() || item->rows.size() != side) {
      complaint_.add(item->line,
                     item->value.empty() ? fmt::format("{} has {} rows", key, item->rows.size())
                                         : fmt::format("{} = {}", key, item->value),
                     fmt::format("{0} rows of {0} numbers below it, for {1}", size, of_what));
      return std::nullopt;
    }
    Eigen::MatrixXd matrix(size, size);
    for (int i = 0; i < size; ++i)
      read_row(key, item->rows[static_cast<std::size_t>(i)], matrix, i);
    if (complaint_.empty()) check_covariance(key, *item, matrix);
    return matrix;
  }

  void read_row(std::string_view key, const CameraRow& row, Eigen::MatrixXd& matrix, int i) {
    const std::vector<double> values = read_numbers(row.line, key, row.text);
    if (values.size() != static_cast<std::size_t>(matrix.cols())) {
      return complaint_.add(row.line,
                            fmt::format("row {} of {} has {} numbers", i + 1, key, values.size()),
                            fmt::format("{}", matrix.cols()));
    }
    for (int j = 0; j < matrix.cols(); ++j) matrix(i, j) = values[static_cast<std::size_t>(j)];
  }

  void check_covariance(std::string_view key, const CameraItem& item, const Eigen::MatrixXd& m) {
    for (int i = 0; i < m.rows(); ++i) {
      const std::size_t line = item.rows[static_cast<std::size_t>(i)].line;
      if (m(i, i) < 0.0) {
        complaint_.add(line, fmt::format("{}({},{}) is {:.9g}", key, i + 1, i + 1, m(i, i)),
                       "a variance, not negative");
      }
      for (int j = 0; j < i; ++j) {
        const double larger = std::max(std::abs(m(i, j)), std::abs(m(j, i)));
        if (std::abs(m(i, j) - m(j, i)) <= kSymmetryTolerance * larger) continue;
        complaint_.add(line,
                       fmt::format("{0}({1},{2}) is {3:.9g}, {0}({2},{1}) is {4:.9g}", key, i + 1,
                                   j + 1, m(i, j), m(j, i)),
                       "a symmetric matrix");
      }
    }
  }

  Complaint complaint_;
  CameraLines lines_;
};

}  // namespace

Result<CameraFile> parse_camera_text(const std::string& text, const std::string& name) {
  return CameraParser(name).parse(text);
}

}  // namespace dottrack::config
