// The large dots that the cameras are calibrated by: on dark plates on the walls, on the boards and
// on the floor, all around the sandbox, and on dark boxes that stand on the sand.

#include <algorithm>
#include <cmath>

#include "host_sim/world/hall_parts.h"
#include "host_sim/world/meshes.h"

namespace dottrack::host_sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPlate_m = 0.42;
constexpr double kPlateThickness_m = 0.012;

struct CalibrationDot {
  Vector3d centre_m;
  Vector3d normal;
  double radius_m;
  bool on_floor;
  double height_m = kPlateThickness_m;  // of what it is on, below it
};

struct Edge {
  Vector2d place;    // on the inner face of the boards
  Vector2d outward;  // unit
};

// Around the sandbox, `share` of the way, counter-clockwise from the south-western corner.
Edge around(double length_m, double width_m, double share) {
  double way_m = share * 2.0 * (length_m + width_m);
  if (way_m < length_m) return {{way_m - 0.5 * length_m, -0.5 * width_m}, {0.0, -1.0}};
  way_m -= length_m;
  if (way_m < width_m) return {{0.5 * length_m, way_m - 0.5 * width_m}, {1.0, 0.0}};
  way_m -= width_m;
  if (way_m < length_m) return {{0.5 * length_m - way_m, 0.5 * width_m}, {0.0, 1.0}};
  way_m -= length_m;
  return {{-0.5 * length_m, 0.5 * width_m - way_m}, {-1.0, 0.0}};
}

CalibrationDot on_wall(const Edge& edge, RandomStream& random) {
  const Vector2d p = edge.place + (kAisle_m - kPlateThickness_m) * edge.outward;
  const double height_m = random.uniform(2.1, 3.0);
  return {{p.x(), p.y(), height_m}, {-edge.outward.x(), -edge.outward.y(), 0.0}, 0.0, false};
}

// Leaning above the boards, where cameras up there see it well.
CalibrationDot on_boards(const Edge& edge) {
  const Vector2d p = edge.place + 0.5 * kBoard_m * edge.outward;
  return {{p.x(), p.y(), kBoardTop_m + 0.17},
          Vector3d(-edge.outward.x(), -edge.outward.y(), 0.75).normalized(),
          0.0,
          false};
}

CalibrationDot on_floor(const Edge& edge) {
  const Vector2d p = edge.place + 0.36 * edge.outward;
  return {{p.x(), p.y(), kPlateThickness_m}, Vector3d::UnitZ(), 0.0, true};
}

std::vector<CalibrationDot> calibration_dots(const HallOptions& options) {
  RandomStream random(options.seed, 0xCA1);
  std::vector<CalibrationDot> dots;
  for (int i = 0; i < options.calibration_dots; ++i) {
    const double share = (i + random.uniform(0.3, 0.7)) / options.calibration_dots;
    const Edge edge = around(options.length_m, options.width_m, share);
    const bool no_wall = edge.outward.x() > 0.5;  // the bay
    const bool window =
        edge.outward.y() > 0.5 && std::abs(edge.place.x() + 0.2 * options.length_m) < 2.1;
    if (i % 3 == 0 && !no_wall && !window) {
      dots.push_back(on_wall(edge, random));
    } else {
      dots.push_back(i % 3 == 1 ? on_boards(edge) : on_floor(edge));
    }
    dots.back().radius_m = random.uniform(0.10, 0.15);
  }
  return dots;
}

// One in each cell of a lattice over the sandbox, at heights that differ: dots in one plane do not
// determine a camera.
std::vector<CalibrationDot> dots_on_boxes(const HallSite& site) {
  const int count = site.options.calibration_boxes;
  std::vector<CalibrationDot> dots;
  if (count == 0) return dots;
  RandomStream random(site.options.seed, 0xCA2);
  const double cell_m = std::sqrt(site.options.length_m * site.options.width_m / count);
  const int rows = std::max(1, static_cast<int>(std::lround(site.options.width_m / cell_m)));
  for (int i = 0; i < count; ++i) {
    const int row = i % rows;
    const int columns = count / rows + (row < count % rows ? 1 : 0);
    const Vector2d share{(i / rows + random.uniform(0.25, 0.75)) / columns - 0.5,
                         (row + random.uniform(0.25, 0.75)) / rows - 0.5};
    const Vector2d p(share.x() * site.options.length_m, share.y() * site.options.width_m);
    const double height_m = random.uniform(0.15, 1.3);
    const double top_m = site.terrain.height_m(p) + height_m;
    dots.push_back({{p.x(), p.y(), top_m}, Vector3d::UnitZ(), 0.0, true, height_m + 0.2});
    dots.back().radius_m = random.uniform(0.06, 0.10);
  }
  return dots;
}

std::vector<CalibrationDot> all_calibration_dots(const HallSite& site) {
  std::vector<CalibrationDot> dots = calibration_dots(site.options);
  for (const CalibrationDot& dot : dots_on_boxes(site)) dots.push_back(dot);
  return dots;
}

}  // namespace

void add_calibration_dots(Model& hall, const HallSite& site, GroundPlan& plan) {
  for (const CalibrationDot& dot : all_calibration_dots(site)) {
    Pose plate = facing(dot.centre_m, dot.normal);
    plate.position_m -= 0.5 * dot.height_m * dot.normal;
    const Material dark{0.09, Pattern::plain, 0.05};
    const std::size_t part = add(hall, box(plate, {kPlate_m, kPlate_m, dot.height_m}), dark);
    hall.marks.push_back({dot.centre_m, dot.normal, dot.radius_m, 0.88, part});
    if (dot.on_floor) plan.take(dot.centre_m.head<2>(), 0.5 * kPlate_m);
  }
}

std::vector<Vector3d> calibration_dot_centres(const HallOptions& options, const Terrain& terrain) {
  std::vector<Vector3d> centres;
  for (const CalibrationDot& dot : all_calibration_dots({options, terrain, {}})) {
    centres.push_back(dot.centre_m);
  }
  return centres;
}

}  // namespace dottrack::host_sim
