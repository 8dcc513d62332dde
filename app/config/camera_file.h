#pragma once
// The JPL text format of camera models (CCALADJ style), read strictly and written exactly.

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "app/core/geometry/camera_model.h"
#include "hal/base/result.h"

namespace dottrack::config {

struct ImageSize {
  int columns = 0;
  int rows = 0;
};

struct CameraFile {
  geometry::CameraModel model;
  std::optional<ImageSize> dimensions;
  std::string comment;                        // first line, without the leading "# "
  std::optional<Eigen::MatrixXd> covariance;  // S: 12x12, 18x18 or 21x21, order C A H V [O R [E]]
};

// Start-up only. An error names file, line and what was expected.
Result<CameraFile> read_camera_file(const std::filesystem::path& path);

// The same from text; `name` stands for the file in messages.
Result<CameraFile> parse_camera_text(const std::string& text, const std::string& name);

// Text that JPL's own reader reads and that parses back to exactly the same numbers.
std::string write_camera_text(const CameraFile& file);

}  // namespace dottrack::config
