// Camera files from model to text: JPL's keys in JPL's order and spelling, because its reader scans
// forward for them, and every number with the digits that bring it back exactly.

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "app/config/camera_file.h"
#include "app/config/camera_internal.h"
#include "app/config/complaint.h"

namespace dottrack::config {
namespace {

std::string model_line(const geometry::CameraModel& model) {
  if (std::holds_alternative<geometry::Cahv>(model)) return "CAHV = perspective, linear";
  if (std::holds_alternative<geometry::Cahvor>(model)) return "CAHVOR = perspective, distortion";
  const double linearity = std::get<geometry::Cahvore>(model).linearity;
  if (linearity == 1.0) return "CAHVORE1 = perspective, distortion, pupil";
  if (linearity == 0.0) return "CAHVORE2 = fish-eye";
  return fmt::format("CAHVORE3,{} = general", shortest(linearity));
}

std::string vector_line(char key, const Eigen::Vector3d& v) {
  return fmt::format("{} = {:>24} {:>24} {:>24}\n", key, shortest(v.x()), shortest(v.y()),
                     shortest(v.z()));
}

std::string vector_lines(const geometry::CameraModel& model) {
  const geometry::Cahv linear = linear_part(model);
  std::string text = vector_line('C', linear.c) + vector_line('A', linear.a) +
                     vector_line('H', linear.h) + vector_line('V', linear.v);
  if (const auto* cahvor = std::get_if<geometry::Cahvor>(&model)) {
    text += vector_line('O', cahvor->o) + vector_line('R', cahvor->r);
  }
  if (const auto* cahvore = std::get_if<geometry::Cahvore>(&model)) {
    text +=
        vector_line('O', cahvore->o) + vector_line('R', cahvore->r) + vector_line('E', cahvore->e);
  }
  return text;
}

std::string matrix_lines(std::string_view key, const Eigen::MatrixXd& matrix) {
  std::string text = fmt::format("\n{} =\n", key);
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < matrix.cols(); ++j) text += fmt::format(" {:>23}", shortest(matrix(i, j)));
    text += '\n';
  }
  return text;
}

std::string internal_lines(const geometry::Cahv& m) {
  const InternalModel internal = internal_model(m.a, m.h, m.v);
  return fmt::format(
      "\nHs    = {:>24}\nHc    = {:>24}\nVs    = {:>24}\nVc    = {:>24}\n"
      "Theta = {:>24} ({:.6f} deg)\n",
      shortest(internal.hs), shortest(internal.hc), shortest(internal.vs), shortest(internal.vc),
      shortest(internal.theta), internal.theta * 180.0 / std::numbers::pi);
}

// Propagated from the covariance of C, A, H and V, so that the two never disagree.
Eigen::MatrixXd internal_covariance(const geometry::Cahv& m, const Eigen::MatrixXd& covariance) {
  const Eigen::Matrix<double, 5, 12> j = internal_jacobian(m.a, m.h, m.v);
  const Eigen::MatrixXd propagated = j * covariance.topLeftCorner<12, 12>() * j.transpose();
  return 0.5 * (propagated + propagated.transpose());
}

std::string on_one_line(std::string comment) {
  std::replace_if(
      comment.begin(), comment.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return comment;
}

}  // namespace

std::string write_camera_text(const CameraFile& file) {
  std::string text =
      fmt::format("# {}\n\nModel = {}\n\n", on_one_line(file.comment), model_line(file.model));
  if (file.dimensions) {
    text += fmt::format("Dimensions = {} {}\n\n", file.dimensions->columns, file.dimensions->rows);
  }
  const geometry::Cahv linear = linear_part(file.model);
  text += vector_lines(file.model);
  if (file.covariance) text += matrix_lines("S", *file.covariance);
  text += internal_lines(linear);
  if (file.covariance) {
    text += matrix_lines("S internal", internal_covariance(linear, *file.covariance));
  }
  return text;
}

}  // namespace dottrack::config
