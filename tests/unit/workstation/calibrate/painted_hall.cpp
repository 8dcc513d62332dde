#include "tests/unit/workstation/calibrate/painted_hall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <string>

namespace dottrack::test {
namespace {

using calibrate::SurveyedDot;
using Eigen::Vector2d;
using Eigen::Vector3d;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vector3d cube(double half) {
    const double x = uniform(-half, half);
    const double y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }

 private:
  std::mt19937_64 engine_;
};

geometry::Cahvor looking(const Vector3d& from, const Vector3d& at, const Vector3d& up,
                         double focal_px, double k1) {
  const Vector3d a = (at - from).normalized();
  const Vector3d right = a.cross(up).normalized();
  const Vector3d down = a.cross(right);
  return {from,
          a,
          focal_px * right + 0.5 * (kPaintedColumns - 1) * a,
          focal_px * down + 0.5 * (kPaintedRows - 1) * a,
          a,
          {0.0, k1, 0.0}};
}

SurveyedDot dot_at(const std::string& name, const Vector3d& place, double diameter_m) {
  SurveyedDot dot;
  dot.name = name;
  dot.position_m = place;
  dot.diameter_m = diameter_m;
  dot.normal = Vector3d::UnitZ();
  return dot;
}

std::vector<Vector2d> rim_of(const geometry::CameraModel& model, const SurveyedDot& dot) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 48.0;
    const Vector3d at =
        dot.position_m + 0.5 * dot.diameter_m * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    Vector2d pixel;
    if (geometry::project(model, at, pixel) != geometry::OpticsStatus::ok) return {};
    rim.push_back(pixel);
  }
  return rim;
}

bool holds(const std::vector<Vector2d>& rim, const Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = rim.size() - 1; i < rim.size(); j = i++) {
    if ((rim[i].y() > p.y()) == (rim[j].y() > p.y())) continue;
    const double x =
        rim[i].x() + (p.y() - rim[i].y()) * (rim[j].x() - rim[i].x()) / (rim[j].y() - rim[i].y());
    inside = inside != (p.x() < x);
  }
  return inside;
}

class Canvas {
 public:
  void fill(const std::vector<Vector2d>& rim, double contrast_dn) {
    if (rim.empty()) return;
    Vector2d low = rim.front();
    Vector2d high = rim.front();
    for (const Vector2d& p : rim) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const auto clip = [](double v, int most) {
      return std::clamp(static_cast<int>(std::lround(v)), 0, most);
    };
    for (int y = clip(low.y() - 1, kPaintedRows - 1); y <= clip(high.y() + 1, kPaintedRows - 1);
         ++y) {
      for (int x = clip(low.x() - 1, kPaintedColumns - 1);
           x <= clip(high.x() + 1, kPaintedColumns - 1); ++x) {
        light_[index(x, y)] += contrast_dn * covered(rim, x, y);
      }
    }
  }

  void write(const std::filesystem::path& file, Random& random) const {
    std::ofstream out(file, std::ios::binary);
    out << "P5\n" << kPaintedColumns << " " << kPaintedRows << "\n255\n";
    for (int y = 0; y < kPaintedRows; ++y) {
      for (int x = 0; x < kPaintedColumns; ++x) {
        const double floor = 40.0 + 0.05 * x + 0.03 * y;
        const double value = floor + light_[index(x, y)] + random.uniform(-2.0, 2.0);
        out.put(static_cast<char>(static_cast<unsigned char>(std::clamp(value, 0.0, 255.0))));
      }
    }
  }

 private:
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * kPaintedColumns + static_cast<std::size_t>(x);
  }
  static double covered(const std::vector<Vector2d>& rim, int x, int y) {
    constexpr int kSides = 5;
    int in = 0;
    for (int i = 0; i < kSides * kSides; ++i) {
      const Vector2d at(x - 0.5 + (i % kSides + 0.5) / kSides,
                        y - 0.5 + (i / kSides + 0.5) / kSides);
      in += holds(rim, at) ? 1 : 0;
    }
    return in / static_cast<double>(kSides * kSides);
  }

  std::vector<double> light_ = std::vector<double>(
      static_cast<std::size_t>(kPaintedColumns) * static_cast<std::size_t>(kPaintedRows), 0.0);
};

}  // namespace

PaintedHall painted_hall() {
  Random random(7);
  PaintedHall hall;
  for (int i = 0; i < 40; ++i) {
    const double x = -4.0 + (i % 8 + random.uniform(0.1, 0.9));
    const double y = -3.0 + (i / 8 + random.uniform(0.1, 0.9)) * 1.2;
    const double z = i % 2 == 0 ? 0.0 : random.uniform(0.2, 1.2);
    hall.dots.push_back(dot_at("d" + std::to_string(i), {x, y, z}, 0.16));
  }
  for (int i = 0; i < 4; ++i) {
    const Vector3d from(i % 2 == 0 ? -5.0 : 5.0, i / 2 == 0 ? -4.0 : 4.0, 4.0 + 0.2 * i);
    const Vector3d at = Vector3d(0.3 * i - 0.5, 0.4 - 0.2 * i, 0.2);
    hall.truths.emplace_back(looking(from, at, Vector3d::UnitZ(), 480.0 + 10.0 * i, -0.1));
    hall.guesses.emplace_back(looking(from + random.cube(0.2), at + random.cube(0.3),
                                      Vector3d::UnitZ() + random.cube(0.03), 485.0, 0.0));
  }
  return hall;
}

PaintedHall painted_plate() {
  PaintedHall plate;
  for (int column = 0; column < 9; ++column) {
    for (int row = 0; row < 8; ++row) {
      if (column == 8 && row < 3) continue;
      const double z = column < 3 ? 0.0 : (column < 6 ? -0.008 : -0.004);
      plate.dots.push_back(dot_at(std::to_string(column) + "-" + std::to_string(row),
                                  {0.005 * column, 0.005 * row, z}, 0.0015));
    }
  }
  const Vector3d middle(0.02, 0.018, -0.004);
  plate.truths.emplace_back(looking({-0.06, 0.03, 0.18}, middle, Vector3d::UnitY(), 1900.0, 0.05));
  plate.truths.emplace_back(  // on its side
      looking({0.12, -0.02, 0.17}, middle, Vector3d::UnitX(), 1800.0, 0.05));
  plate.guesses = plate.truths;
  return plate;
}

std::vector<calibrate::CameraInput> paint(const PaintedHall& hall,
                                          const std::filesystem::path& folder) {
  std::vector<calibrate::CameraInput> inputs;
  for (std::size_t c = 0; c < hall.truths.size(); ++c) {
    Random random(100 + c);
    Canvas canvas;
    for (const SurveyedDot& dot : hall.dots) canvas.fill(rim_of(hall.truths[c], dot), 120.0);
    for (int i = 0; i < 15; ++i) {
      SurveyedDot other = hall.dots[static_cast<std::size_t>(i) * hall.dots.size() / 15];
      const double size = 2.0 * (hall.dots[1].position_m - hall.dots[0].position_m).norm();
      other.position_m += random.cube(0.4 * size);
      canvas.fill(rim_of(hall.truths[c], other), 60.0);
    }
    const std::string name = "cam" + std::to_string(c + 1);
    canvas.write(folder / (name + ".pgm"), random);
    inputs.push_back({{name, {folder / (name + ".pgm")}, {}}, {}, {}, {}});
  }
  return inputs;
}

Right right_ones(const PaintedHall& hall, std::size_t camera, const calibrate::CameraViews& views,
                 double within_px) {
  Right right;
  for (const calibrate::Observation& o : views.observations) {
    Vector2d pixel;
    const auto status = geometry::project(hall.truths[camera], hall.dots[o.dot].position_m, pixel);
    const bool near = status == geometry::OpticsStatus::ok && (pixel - o.pixel).norm() < within_px;
    right.right += near ? 1U : 0U;
    ++right.all;
  }
  return right;
}

}  // namespace dottrack::test
