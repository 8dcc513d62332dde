// A real plate of 437 dots seen by three cameras, labels given: fitted to half of the dots, tested
// on the others.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/geometry/triangulation.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "tests/support/shared_data.h"

namespace dottrack::calibrate {
namespace {

using Eigen::Vector2d;

std::vector<std::vector<double>> rows_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    std::stringstream cells(line);
    auto& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return rows;
}

struct Plate {
  std::vector<SurveyedDot> dots;
  std::vector<CameraViews> fitted;
  std::vector<CameraViews> tested;
};

Plate plate(const std::filesystem::path& folder, int remainder) {
  Plate out;
  std::map<int, std::size_t> index;
  for (const auto& row : rows_of(folder / "dots3d.csv")) {
    index[static_cast<int>(row[0])] = out.dots.size();
    SurveyedDot& dot = out.dots.emplace_back();
    dot.name = std::to_string(static_cast<int>(row[0]));
    dot.position_m = Eigen::Vector3d(row[1], row[2], row[3]) * 1e-3;
  }
  for (int camera = 1; camera <= 3; ++camera) {
    const std::string name = "cam" + std::to_string(camera);
    CameraViews views;
    views.name = name;
    views.width_px = 1280;
    views.height_px = 1024;
    out.fitted.push_back(views);
    out.tested.push_back(views);
    for (const auto& row : rows_of(folder / ("observations_" + name + ".csv"))) {
      const int id = static_cast<int>(row[0]);
      auto& to = id % 2 == remainder ? out.fitted.back() : out.tested.back();
      to.observations.push_back({index.at(id), Vector2d(row[1], row[2])});
    }
  }
  return out;
}

struct Reached {
  double rms_px = 0.0;
  double rms_mm = 0.0;
  std::size_t dots = 0;
};

Reached reached(const Plate& plate, const Calibration& found) {
  Reached out;
  double square_px = 0.0;
  double square_m = 0.0;
  std::size_t views = 0;
  std::map<std::size_t, std::vector<geometry::SightLine>> lines;
  for (std::size_t i = 0; i < plate.tested.size(); ++i) {
    for (const Observation& o : plate.tested[i].observations) {
      Vector2d pixel;
      geometry::SightLine line;
      const geometry::CameraModel& model = found.cameras[i].model;
      EXPECT_EQ(project(model, plate.dots[o.dot].position_m, pixel), geometry::OpticsStatus::ok);
      EXPECT_EQ(unproject(model, o.pixel, line.ray), geometry::OpticsStatus::ok);
      square_px += (pixel - o.pixel).squaredNorm();
      ++views;
      lines[o.dot].push_back(line);
    }
  }
  for (const auto& [dot, of_dot] : lines) {
    geometry::Triangulation point;
    if (triangulate(of_dot, point) != geometry::TriangulationStatus::ok) continue;
    square_m += (point.point_m - plate.dots[dot].position_m).squaredNorm();
    ++out.dots;
  }
  out.rms_px = std::sqrt(square_px / static_cast<double>(views));
  out.rms_mm = 1e3 * std::sqrt(square_m / static_cast<double>(out.dots));
  return out;
}

TEST(RealPlateFit, HoldsOnTheOtherHalfOfTheDots) {
  const auto shared = test::shared_data();
  if (!shared) GTEST_SKIP() << "shared data absent: real_plate";
  for (const int remainder : {0, 1}) {
    const Plate given = plate(*shared / "real_plate" / "myptv", remainder);
    const auto found = calibrate(given.dots, given.fitted);
    ASSERT_TRUE(found) << found.error().message;
    const Reached r = reached(given, *found);
    RecordProperty("rms_px_" + std::to_string(remainder), std::to_string(r.rms_px));
    RecordProperty("rms_mm_" + std::to_string(remainder), std::to_string(r.rms_mm));
    EXPECT_GT(r.dots, 200U);
    EXPECT_LT(r.rms_px, 0.35);
    EXPECT_LT(r.rms_mm, 0.057);
    EXPECT_LT(found->survey_scale, 0.05);  // a millimetre was assumed, the plate is far better
  }
}

}  // namespace
}  // namespace dottrack::calibrate
