#pragma once
// Whether a target's dots tell its pose: how well, and without mistaking some of its dots for
// others.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/config/relabelling.h"
#include "app/core/rig.h"

namespace dottrack::config {

// A lock is held back while another labelling is more than one millionth as probable. With errors
// of sigma in each coordinate, a wrong labelling of total misfit D is less probable by
// exp(-D^2 / (2 sigma^2)) on average, and the errors change the exponent by D / sigma (one standard
// deviation). At 9 sigma the exponent is 40.5, and still 13.5 - one in 700 thousand - where three
// of these standard deviations go against it.
inline constexpr double kTellApart = 9.0;

// A relabelling that shifts the target by less than so many standard deviations does no harm.
inline constexpr double kNoticeable = 3.0;

// An attitude known worse than this, one standard deviation about the worst axis, is of little use.
inline constexpr double kMostAttitude_deg = 2.0;

// Acquisition locks on no fewer dots, but for a target that has no more.
inline constexpr std::size_t kFewestDots = 4;

// What one millimetre of error in each coordinate of each dot makes of the pose: one standard
// deviation along, or about, the worst axis.
struct Conditioning {
  double attitude_deg_per_mm = 0.0;
  double position_mm_per_mm = 0.0;  // of the vehicle's origin
};

Conditioning conditioning_of(const core::Target& target);

struct TargetJudgement {
  std::size_t target_dots = 0;
  double sigma_m = 0.0;  // expected error of a dot's place in each coordinate
  Conditioning conditioning;
  LeastMisfit all;                  // over the relabellings of all dots
  LeastMisfit few;                  // of the fewest dots that a lock may have, if not all
  std::optional<Relabelling> most;  // the one of most dots that cannot be told from the truth
  bool complete = true;             // or some searches were given up

  // The total misfit that tells a relabelling from the truth.
  double needed_m() const { return kTellApart * sigma_m; }
  // All dots can be taken for one another: no lock on this target is certain.
  bool ambiguous() const;
  bool well_conditioned() const;
  // Any so many of its dots cannot be mistaken for others of them.
  std::size_t dots_needed() const;
};

// Relabellings are looked for up to `reach` times the misfit that tells them from the truth.
TargetJudgement judge(const core::Target& target, double sigma_m, double reach = 1.0);

struct DotMove {
  std::size_t dot = 0;
  Eigen::Vector3d to_m = Eigen::Vector3d::Zero();  // vehicle coordinates, in tenths of a millimetre
  double by_m = 0.0;
};

// The smallest move of one dot, in its plane, that makes an ambiguous target good; of two or three
// dots where one is not enough; empty when none was found.
std::vector<DotMove> moves_to_tell_apart(const core::Target& target, double sigma_m);

}  // namespace dottrack::config
