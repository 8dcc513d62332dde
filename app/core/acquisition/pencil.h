#pragma once
// Two cameras' lines of sight in the pencil of planes around the line through both centres.
//
// A ray lies in one plane of the pencil, at an angle phi around the baseline, and leaves the
// baseline at an interior angle with cotangent c. Where two rays cross, rho from the baseline of
// length B, B / rho = c_a + c_b; the ranges are rho / sine. So what a ray's window of ranges,
// bounding box and the largest miss allow of the other ray is, up to a margin, an interval of the
// other's phi and one of its c. With mu = the largest miss + how far ray origins are off the
// centres, the exact statements are, for any accepted crossover of ranges r and rho = r * sine:
//   rho_a c_a + rho_b c_b = B +- mu,   |rho_a - rho_b| <= mu,   sin |phi_a - phi_b| <= mu / rho,
//   and half the miss <= r * box_tangent.
// The intervals follow from these, widened by more than single precision can err. They are
// conservative: no pair that test_pair accepts is outside them.

#include <Eigen/Core>

#include "app/core/acquisition/ray_arrays.h"
#include "hal/base/static_vector.h"

namespace dottrack::acquisition {

// What single precision adds to lengths, a part of them.
inline constexpr float kRoundingPart = 1e-5F;

struct Pencil {
  // The directions' sums say where the scene is: angles are measured from the plane towards it.
  Pencil(const RayArrays& a, const RayArrays& b, double max_miss_m);

  // False when the centres coincide: the cameras see along the same lines and form no pairs.
  bool has_baseline() const { return baseline_m > 0.0; }

  Eigen::Vector3d along = Eigen::Vector3d::Zero();  // unit, from a to b
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  double baseline_m = 0.0;
  double max_miss_m = 0.0;
  double origin_offset_m = 0.0;  // both cameras'
};

// One camera's rays in the pencil, and what each asks of the other camera's ray.
struct PencilRays {
  alignas(32) FloatArray angle{};      // rad
  alignas(32) FloatArray cotangent{};  // of the interior angle to the baseline
  alignas(32) FloatArray sine{};
  alignas(32) FloatArray half_width{};  // of the interval of angles; negative: no partner at all
  alignas(32) FloatArray low{};         // the interval of the other's cotangent
  alignas(32) FloatArray high{};
  // The angle between the planes is at most slope * (sum of the cotangents) + offset.
  alignas(32) FloatArray miss_slope{};
  alignas(32) FloatArray miss_offset{};
  float least_angle = 0.0F;
  float greatest_angle = 0.0F;
  // Rays so close to the baseline that their plane is not known well enough: angle and cotangent
  // say nothing.
  StaticVector<std::uint16_t, core::kMaxRegions> stray;

  bool is_stray(std::size_t i) const { return !(sine[i] >= kLeastSine); }

  static constexpr float kLeastSine = 1.0F / 128.0F;
};

enum class PencilEnd : std::uint8_t { a, b };

void unfold(const Pencil& pencil, PencilEnd end, const RayArrays& rays, PencilRays& result);

}  // namespace dottrack::acquisition
