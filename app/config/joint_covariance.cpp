#include "app/config/joint_covariance.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "app/config/camera_lines.h"
#include "app/config/complaint.h"

namespace dottrack::config {
namespace {

using Eigen::Index;

constexpr std::string_view kHeader = "camera,row_up_to_the_diagonal";

// No combination of errors has a negative variance, but for what the file rounds.
bool is_covariance(const Eigen::MatrixXd& matrix) {
  constexpr double kRounding = -1e-6;
  const Eigen::VectorXd variances = matrix.diagonal();
  if (variances.minCoeff() < 0.0) return false;
  const Eigen::VectorXd scale =
      variances.unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 1.0; });
  const Eigen::MatrixXd correlation = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() > kRounding;
}

class JointParser {
 public:
  explicit JointParser(const std::string& name) : complaint_(name) {}

  Result<JointCovariance> parse(std::string_view text) {
    while (!text.empty() && complaint_.empty()) {
      const auto end = text.find('\n');
      ++line_;
      read_line(trimmed_blanks(text.substr(0, end)));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    check_camera();
    if (joint_.cameras.empty()) complaint_.add(line_, "no camera", "rows of numbers");
    if (complaint_.empty() && !is_covariance(joint_.covariance)) {
      complaint_.add(line_, "numbers that no errors can have together",
                     "a covariance, as dottrack calibrate wrote it");
    }
    if (!complaint_.empty()) return tl::unexpected<Error>(complaint_.first());
    return std::move(joint_);
  }

 private:
  void read_line(std::string_view line) {
    if (line.empty() || line.front() == '#') return;
    if (has_header_) return read_row(line);
    has_header_ = line == kHeader;
    if (!has_header_) complaint_.add(line_, "header " + in_quotes(line), kHeader);
  }

  void read_row(std::string_view line) {
    const auto comma = line.find(',');
    const std::string name(trimmed_blanks(line.substr(0, comma)));
    if (joint_.cameras.empty() || joint_.cameras.back().name != name) begin_camera(name);
    ++joint_.cameras.back().size;
    const Index row = joint_.covariance.rows();
    joint_.covariance.conservativeResize(row + 1, row + 1);
    std::string_view left = comma == std::string_view::npos ? "" : line.substr(comma + 1);
    for (Index column = 0; column <= row && complaint_.empty(); ++column) {
      joint_.covariance(row, column) = joint_.covariance(column, row) = take_number(left, row);
    }
    if (!left.empty()) complain_of_length(row);
  }

  void begin_camera(const std::string& name) {
    check_camera();
    if (joint_.find(name) != nullptr) {
      complaint_.add(line_, fmt::format("camera {} again", in_quotes(name)),
                     "the rows of a camera one after the other");
    }
    joint_.cameras.push_back({name, joint_.covariance.rows(), 0});
  }

  // That the camera of the rows so far is whole.
  void check_camera() {
    if (joint_.cameras.empty()) return;
    const JointCovariance::Camera& camera = joint_.cameras.back();
    if (camera.size == 12 || camera.size == 18 || camera.size == 21) return;
    complaint_.add(line_, fmt::format("{} rows of camera {}", camera.size, in_quotes(camera.name)),
                   "12, 18 or 21 rows: C A H V [O R [E]]");
  }

  double take_number(std::string_view& left, Index row) {
    if (left.empty()) {
      complain_of_length(row);
      return 0.0;
    }
    const auto comma = left.find(',');
    const std::string_view field = trimmed_blanks(left.substr(0, comma));
    left = comma == std::string_view::npos ? "" : left.substr(comma + 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.begin(), field.end(), value);
    if (error == std::errc() && end == field.end() && std::isfinite(value)) return value;
    complaint_.add(line_, "a covariance is " + in_quotes(field), "a number");
    return 0.0;
  }

  void complain_of_length(Index row) {
    complaint_.add(line_, "a row of another length",
                   fmt::format("a camera's name and {} numbers", row + 1));
  }

  Complaint complaint_;
  JointCovariance joint_;
  std::size_t line_ = 0;
  bool has_header_ = false;
};

}  // namespace

const JointCovariance::Camera* JointCovariance::find(const std::string& name) const {
  const auto at = std::find_if(cameras.begin(), cameras.end(),
                               [&](const Camera& camera) { return camera.name == name; });
  return at == cameras.end() ? nullptr : &*at;
}

Result<JointCovariance> parse_joint_covariance(const std::string& text, const std::string& name) {
  return JointParser(name).parse(text);
}

std::string write_joint_covariance(const JointCovariance& joint) {
  std::string text =
      "# How the cameras' models may be wrong together: the covariance of all their vectors\n"
      "# C A H V [O R [E]], camera after camera.\n";
  text += fmt::format("{}\n", kHeader);
  for (const JointCovariance::Camera& camera : joint.cameras) {
    for (Index row = camera.first; row < camera.first + camera.size; ++row) {
      text += camera.name;
      for (Index column = 0; column <= row; ++column) {
        text += fmt::format(",{:.10g}", joint.covariance(row, column));
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace dottrack::config
