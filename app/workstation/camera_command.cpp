#include "app/workstation/camera_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

#include "app/config/camera_file.h"
#include "app/workstation/complain.h"
#include "app/workstation/exit_status.h"

namespace dottrack::workstation {
namespace {

using geometry::CameraModel;
using geometry::OpticsStatus;

constexpr std::string_view kProjectHeader =
    "X,Y,Z,status,x,y,dx_dX,dx_dY,dx_dZ,dy_dX,dy_dY,dy_dZ\n";
constexpr std::string_view kUnprojectHeader =
    "x,y,status,ox,oy,oz,ux,uy,uz,dox_dx,dox_dy,doy_dx,doy_dy,doz_dx,doz_dy,"
    "dux_dx,dux_dy,duy_dx,duy_dy,duz_dx,duz_dy\n";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// NaN and infinities are numbers here: the model answers not_finite.
std::optional<double> to_number(std::string_view field) {
  const bool plus = field.starts_with('+') && !field.starts_with("+-");
  const std::string_view digits = plus ? field.substr(1) : field;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

// One line's fields: all of them numbers, or how many were.
template <std::size_t N>
struct Fields {
  std::array<double, N> values{};
  std::size_t count = 0;
  std::size_t numbers = 0;

  bool complete() const { return count == N && numbers == N; }
};

template <std::size_t N>
Fields<N> split(std::string_view line) {
  Fields<N> fields;
  for (;;) {
    const auto comma = line.find(',');
    const auto value = to_number(trimmed(line.substr(0, comma)));
    if (fields.count < N && value) fields.values[fields.count] = *value;
    ++fields.count;
    if (value) ++fields.numbers;
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

template <class Numbers>
void append(std::string& row, const Numbers& numbers) {
  for (const double number : numbers) fmt::format_to(std::back_inserter(row), ",{:.17g}", number);
}

// Row-major, as the columns are named.
template <class Matrix>
void append_matrix(std::string& row, const Matrix& matrix) {
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < matrix.cols(); ++j) append(row, std::array{matrix(i, j)});
  }
}

std::string project_row(const CameraModel& model, const std::array<double, 3>& point) {
  Eigen::Vector2d pixel;
  geometry::ProjectionJacobian jacobian;
  const OpticsStatus status =
      geometry::project(model, {point[0], point[1], point[2]}, pixel, &jacobian);
  std::string row = fmt::format("{:.17g},{:.17g},{:.17g},{}", point[0], point[1], point[2],
                                geometry::to_string(status));
  if (status != OpticsStatus::ok) return row + std::string(8, ',');
  append_matrix(row, pixel);
  append_matrix(row, jacobian);
  return row;
}

std::string unproject_row(const CameraModel& model, const std::array<double, 2>& pixel) {
  geometry::Ray ray;
  geometry::RayJacobian jacobian;
  const OpticsStatus status = geometry::unproject(model, {pixel[0], pixel[1]}, ray, &jacobian);
  std::string row =
      fmt::format("{:.17g},{:.17g},{}", pixel[0], pixel[1], geometry::to_string(status));
  if (status != OpticsStatus::ok) return row + std::string(18, ',');
  append_matrix(row, ray.origin);
  append_matrix(row, ray.direction);
  append_matrix(row, jacobian.origin);
  append_matrix(row, jacobian.direction);
  return row;
}

std::string complaint(std::size_t number, std::string_view line, std::string_view expected) {
  constexpr std::size_t kMostShown = 60;
  std::string shown(line.substr(0, kMostShown));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  return fmt::format("standard input:{}: \"{}\"; expected {}", number, shown, expected);
}

// Every answer goes out at once: whoever writes a line may be waiting for its row.
template <std::size_t N, class Row>
Result<void> filter(std::istream& in, std::ostream& out, std::string_view header,
                    std::string_view expected, Row row) {
  out << header << std::flush;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string_view text = trimmed(line);
    if (!text.empty()) {
      const Fields<N> fields = split<N>(text);
      const bool is_header = number == 1 && fields.numbers == 0;
      if (!is_header && !fields.complete()) return fail(complaint(number, text, expected));
      if (!is_header) out << row(fields.values) << '\n' << std::flush;
    }
    if (!out) return {};
  }
  return {};
}

}  // namespace

Result<void> project_lines(const CameraModel& model, std::istream& in, std::ostream& out) {
  return filter<3>(in, out, kProjectHeader, "X,Y,Z, three numbers",
                   [&](const auto& point) { return project_row(model, point); });
}

Result<void> unproject_lines(const CameraModel& model, std::istream& in, std::ostream& out) {
  return filter<2>(in, out, kUnprojectHeader, "x,y, two numbers",
                   [&](const auto& pixel) { return unproject_row(model, pixel); });
}

namespace {

using LineFilter = Result<void> (*)(const CameraModel&, std::istream&, std::ostream&);

int run(const std::string& path, LineFilter lines) {
  const Result<config::CameraFile> file = config::read_camera_file(path);
  if (!file) return complain(file.error().message);
  std::ios::sync_with_stdio(false);  // so that std::cin reads in blocks
  std::cin.tie(nullptr);
  const Result<void> result = lines(file->model, std::cin, std::cout);
  if (!result) return complain(result.error().message);
  if (std::cout) return kDone;
  fmt::print(stderr, "dottrack: standard output cannot be written\n");
  return kFailed;
}

void add_direction(CLI::App& camera, const std::string& name, const std::string& description,
                   LineFilter lines, int& exit_status) {
  CLI::App* direction = camera.add_subcommand(name, description);
  const auto path = std::make_shared<std::string>();
  direction->add_option("MODEL", *path, "camera model, JPL text format")->required();
  direction->callback([path, lines, &exit_status] { exit_status = run(*path, lines); });
}

}  // namespace

void add_camera_command(CLI::App& app, int& exit_status) {
  CLI::App* camera =
      app.add_subcommand("camera", "Projects points through a camera model: CSV in, CSV out");
  camera->require_subcommand(1);
  add_direction(*camera, "project", "3-D to 2-D: reads X,Y,Z lines, writes pixels and derivatives",
                project_lines, exit_status);
  add_direction(*camera, "unproject", "2-D to 3-D: reads x,y lines, writes rays and derivatives",
                unproject_lines, exit_status);
}

}  // namespace dottrack::workstation
