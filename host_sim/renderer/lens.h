#pragma once
// How a lens turns the angle off its axis into a radius of its picture. Dimensionless: a radius is
// in units of the focal length.
//   c(a) = tan a                   pinhole and radial lenses
//   c(a) = tan(L a)/L, a, sin(L a)/L   fish-eyes of linearity L > 0, = 0, < 0
//   radius = c (1 + r0 + r1 c^2 + r2 c^4)
// A fish-eye's entrance pupil moves along the axis: the light that comes in at the angle a crosses
// it (a/sin a - 1)(e0 + e1 a^2 + e2 a^4) metres before the camera's centre. That is the family of
// lenses of CAHV, CAHVOR and CAHVORE (Gennery 2006), solved by means of its own.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace dottrack::host_sim {

enum class LensKind : std::uint8_t {
  pinhole,  // neither distortion nor moving pupil
  radial,   // distortion as a polynomial in the tangent
  fisheye,  // all of the above
};

struct Lens {
  double focal_x_px = 460.0;
  double focal_y_px = 460.0;
  double skew_px = 0.0;
  double centre_x_px = 319.5;
  double centre_y_px = 239.5;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // camera axes; a SimCamera normalises it
  std::array<double, 3> radial{0.0, 0.0, 0.0};      // r0 r1 r2
  LensKind kind = LensKind::radial;
  double linearity = 0.0;                        // L, of a fish-eye
  std::array<double, 3> pupil_m{0.0, 0.0, 0.0};  // e0 e1 e2, of a fish-eye
};

// The curve of one lens, as far as it is one-to-one: up to 83 degrees off the axis for a pinhole
// or a radial lens, 140 for a fish-eye, or to where the polynomial folds over.
class LensCurve {
 public:
  explicit LensCurve(const Lens& lens);

  // The radius at which a point shows that is `along` metres before the centre on the axis and
  // `across` metres off it; nothing outside the lens's domain.
  std::optional<double> radius(double along, double across) const;

  // Where the light at a radius of the picture comes from.
  struct Entry {
    double sine;     // of the angle off the axis, up to a common factor with the cosine: a radial
    double cosine;   // lens has cosine 1 here, a fish-eye has unit length
    double pupil_m;  // on the axis, from the camera's centre
  };
  std::optional<Entry> entry(double radius) const;

  // c where the domain ends.
  double max_c() const { return max_c_; }

 private:
  double c_of(double angle_rad) const;
  double angle_of(double c) const;
  double pupil_at(double angle_rad) const;
  std::optional<double> entry_angle(double along, double across) const;

  LensKind kind_;
  std::array<double, 3> radial_;
  double linearity_;
  std::array<double, 3> pupil_m_;
  double max_c_;
};

}  // namespace dottrack::host_sim
