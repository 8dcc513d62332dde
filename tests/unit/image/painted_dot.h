#pragma once
// Pictures of dots that an ideal lens and sensor take: shapes blurred by a Gaussian and integrated
// over each pixel, chord by chord and in closed form along the rows. It knows nothing of distances
// from an outline, which is how fit_dot sees a dot.

#include <Eigen/Core>
#include <random>
#include <vector>

#include "tests/unit/image/pictures.h"

namespace dottrack::image::test {

// The part of the plane where normal . (p - through) > 0.
struct HalfPlane {
  Eigen::Vector2d through = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
};

struct PaintedEllipse {
  Eigen::Vector2d centre{24.0, 24.0};
  double semi_major_px = 4.0;
  double semi_minor_px = 4.0;
  double angle_rad = 0.0;
};

struct Noise {
  double read_dn = 0.0;  // standard deviation
  double per_dn = 0.0;   // variance a grey level: shot noise
};

class Canvas {
 public:
  Canvas(int side_px, double blur_px);

  void add_level(double dn);
  // Zero in the middle.
  void add_slope(const Eigen::Vector2d& dn_per_px);
  // Where the ellipse (null: the whole picture) and all the half planes overlap.
  void paint(const PaintedEllipse* ellipse, const std::vector<HalfPlane>& within, double dn);
  // What exceeds the full well goes on down (three quarters) and up its column.
  void bloom(double full_well_dn);

  // Cut at 0 and 255, rounded.
  Picture expose(const Noise& noise, Random& random) const;
  int side_px() const { return side_; }
  double at(int x, int y) const { return grey_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * side_ + x); }
  std::size_t run_index(int x, int y) const {
    return static_cast<std::size_t>(y * (side_ + 1) + x);
  }
  void add_runs();
  void paint_chord(double y, double height_px, double first, double last, double dn);
  double spread(double t) const;
  double spread_integral(double t) const;

  int side_;
  double blur_;
  std::vector<double> grey_;
  std::vector<double> runs_;  // steps of grey along the rows, while a shape is painted
};

}  // namespace dottrack::image::test
