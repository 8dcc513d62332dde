#pragma once
// Which of a target's dots can be taken for which others of its dots. What a symmetric target has
// is a relabelling that fits as well as the right labels, with another pose.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/core/rig.h"

namespace dottrack::config {

inline constexpr std::uint8_t kLeftOut = 0xFF;

// Some of the target's dots, each taken for the dot label[k], and the pose error that results.
struct Relabelling {
  std::array<std::uint8_t, core::kMaxDots> label{};  // kLeftOut: this dot has no part in it
  std::size_t dots = 0;                              // that have
  double total_m = 0.0;  // root of the sum of squares of what the best rigid motion leaves
  double turn_rad = 0.0;
  double shift_m = 0.0;  // RMS, of all dots of the target

  double misfit_m() const;  // RMS of what the best rigid motion leaves
};

// The relabelling of least misfit, if there is one up to the searched limit.
struct LeastMisfit {
  std::optional<Relabelling> relabelling;
  double searched_m = 0.0;  // no relabelling has a total misfit below this, but for the one above
};

// Exact, by branch and bound over the labels: distances between dots that differ by more than
// sqrt(2) of the total misfit rule a pair of labels out. Dots whose diameters differ by more than
// kDiameterRatio are never taken for one another. Only proper rotations count, for an upright
// target only those that keep its z axis up, and only relabellings that shift the target
// noticeably. A search gives up after a number of steps that is the same everywhere.
class RelabellingSearch {
 public:
  RelabellingSearch(const core::Target& target, double noticeable_m);

  // Of `dots` of the target's dots: the relabelling of least total misfit, up to at_most_m.
  LeastMisfit least(std::size_t dots, double at_most_m);
  // Whether a relabelling of `dots` dots has a total misfit up to at_most_m.
  bool any(std::size_t dots, double at_most_m);
  // The relabelling of most dots, `from_dots` or more, with a total misfit up to at_most_m.
  std::optional<Relabelling> largest(std::size_t from_dots, double at_most_m);

  // Whether the last search came to its end.
  bool complete() const { return complete_; }

 private:
  using Labels = std::uint16_t;  // one bit a label
  using LabelsOfDots = std::array<Labels, core::kMaxDots>;
  enum class Aim : std::uint8_t { least, any, largest };

  void run(Aim aim, std::size_t goal, double at_most_m);
  void rule_out(double at_most_m);
  void take_for(std::size_t dot, std::size_t label);
  void descend(std::size_t next, const LabelsOfDots& allowed);
  void extend(std::size_t dot, std::size_t label, std::size_t next, const LabelsOfDots& allowed);
  bool enough_left(std::size_t next, const LabelsOfDots& allowed) const;
  bool settled();
  void keep(const Relabelling& found);
  bool measure(Relabelling& relabelling, bool& valid) const;
  double bound2() const;

  const core::Target* target_;
  std::size_t count_;
  double noticeable_m_;
  std::array<std::array<double, core::kMaxDots>, core::kMaxDots> distance_m_{};
  std::array<Labels, core::kMaxDots> similar_{};  // labels of about the same diameter
  // compatible_[i][j][k]: labels that dot k may have when dot i has label j.
  std::array<std::array<LabelsOfDots, core::kMaxDots>, core::kMaxDots> compatible_{};

  Aim aim_ = Aim::least;
  std::size_t goal_ = 0;
  double at_most_m_ = 0.0;
  std::array<std::uint8_t, core::kMaxDots> dot_{};    // in the order they were taken
  std::array<std::uint8_t, core::kMaxDots> label_{};  // theirs
  std::array<double, core::kMaxDots + 1> sum2_{};     // of differences of distances, by depth
  std::size_t depth_ = 0;
  std::optional<Relabelling> best_;
  std::uint64_t steps_ = 0;
  bool stop_ = false;
  bool complete_ = true;
};

}  // namespace dottrack::config
