#pragma once
// A curve through way points with a continuous heading: centripetal Catmull-Rom, measured by its
// length.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace dottrack::host_sim {

class SmoothCurve {
 public:
  // Two points or more, no two successive ones equal; a closed one's last is not its first again.
  SmoothCurve(const std::vector<Eigen::Vector2d>& points, bool closed);

  struct Place {
    Eigen::Vector2d position_m;
    Eigen::Vector2d forward;  // unit
  };

  double length_m() const { return along_m_.back(); }
  // `along_m`: way from the first point; before and beyond the ends of an open curve: the ends.
  Place at(double along_m) const;
  // Good to some millimetres.
  double distance_m(const Eigen::Vector2d& p) const;

 private:
  // A cubic over u = 0..1.
  struct Piece {
    Eigen::Vector2d from;
    Eigen::Vector2d to;
    Eigen::Vector2d from_slope;
    Eigen::Vector2d to_slope;

    Eigen::Vector2d position(double u) const;
    Eigen::Vector2d slope(double u) const;
    double length_m(double from_u, double to_u) const;
  };

  std::vector<Piece> pieces_;
  std::vector<double> along_m_;  // at equal steps of u, piece by piece, with both ends
  bool closed_;
};

}  // namespace dottrack::host_sim
