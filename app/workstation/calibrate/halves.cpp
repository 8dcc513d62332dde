#include "app/workstation/calibrate/halves.h"

#include <algorithm>
#include <cmath>

#include "app/core/geometry/triangulation.h"

namespace dottrack::calibrate {

bool is_in(Half half, std::size_t dot) {
  return (dot % 2 == 0) == (half == Half::odd);  // index 0 is number 1
}

std::vector<CameraViews> half_of(std::span<const CameraViews> views, Half half) {
  std::vector<CameraViews> kept(views.begin(), views.end());
  for (CameraViews& camera : kept) {
    std::erase_if(camera.observations, [&](const Observation& o) { return !is_in(half, o.dot); });
  }
  return kept;
}

HalfFigures figures_of(std::span<const SurveyedDot> dots, std::span<const CameraViews> views,
                       const Calibration& calibration, Half half) {
  HalfFigures figures;
  std::vector<std::vector<geometry::SightLine>> lines(dots.size());
  double squares_px = 0.0;
  for (std::size_t c = 0; c < views.size(); ++c) {
    const geometry::CameraModel& model = calibration.cameras[c].model;
    for (const Observation& o : views[c].observations) {
      if (!is_in(half, o.dot)) continue;
      Eigen::Vector2d pixel;
      geometry::SightLine line;
      line.sigma_rad = 1e-3;
      if (geometry::project(model, dots[o.dot].position_m, pixel) != geometry::OpticsStatus::ok ||
          geometry::unproject(model, o.pixel, line.ray) != geometry::OpticsStatus::ok) {
        continue;
      }
      squares_px += (pixel - o.pixel).squaredNorm();
      ++figures.observations;
      lines[o.dot].push_back(line);
    }
  }
  double squares_m2 = 0.0;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    geometry::Triangulation found;
    if (geometry::triangulate(lines[i], found) != geometry::TriangulationStatus::ok) continue;
    squares_m2 += (found.point_m - dots[i].position_m).squaredNorm();
    ++figures.triangulated;
  }
  const auto root_mean = [](double sum, std::size_t n) {
    return n == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(n));
  };
  figures.rms_px = root_mean(squares_px, figures.observations);
  figures.rms_m = root_mean(squares_m2, figures.triangulated);
  return figures;
}

}  // namespace dottrack::calibrate
