#include "app/workstation/target/target_design.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <optional>

#include "app/config/relabelling.h"
#include "app/config/target_judgement.h"
#include "host_sim/world/random.h"

namespace dottrack::workstation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using host_sim::RandomStream;

constexpr double kLargestDiameter_m = 0.050;
constexpr double kSmallPanel_m = 0.3;
// Of the spread that dots strewn evenly over the panel have across its short side.
constexpr double kLeastSpread = 0.6;
constexpr int kThrows = 400;   // of all dots
constexpr int kAttempts = 60;  // at a place for one dot
constexpr int kStarts = 3;
constexpr int kImprovements = 900;
constexpr double kFirstStep = 0.25;  // of the panel's short side
constexpr double kLastStep = 0.004;
constexpr double kWorstFirst = 0.7;  // how often a dot of the worst relabelling is moved

double short_side_m(const Panel& panel) {
  return std::min(panel.length_m, panel.width_m);
}

class Designer {
 public:
  explicit Designer(const DesignRequest& request)
      : request_(request),
        spacing_m_(kSpacing_diameters * request.diameter_m),
        half_m_(0.5 * request.panel.length_m - kMargin_diameters * request.diameter_m,
                0.5 * request.panel.width_m - kMargin_diameters * request.diameter_m),
        grid_m_(short_side_m(request.panel) < kSmallPanel_m ? 1e-4 : 1e-3),
        fewest_(std::min(request.dots, config::kFewestDots)),
        ample_m_(kAmple * config::kTellApart * request.sigma_m),
        random_(request.seed, request.dots) {}

  std::optional<core::Target> design() {
    std::optional<core::Target> best;
    Merit best_merit;
    for (int start = 0; start < kStarts; ++start) {
      if (!begin()) continue;
      for (int i = 0; i < kImprovements; ++i) improve(i);
      if (best && !(best_merit < merit_)) continue;
      best = layout_;
      best_merit = merit_;
    }
    return best;
  }

 private:
  // Compared by misfit, where that is the same by inertia.
  struct Merit {
    double misfit_m = 0.0;    // the least, up to what is ample
    double inertia_m2 = 0.0;  // about the worst axis: the attitude's information
    auto operator<=>(const Merit&) const = default;
  };

  // The best of many throws.
  bool begin() {
    std::optional<core::Target> best;
    for (int i = 0; i < kThrows / kStarts; ++i) {
      const auto thrown = throw_dots();
      if (!thrown || !spread_well(*thrown) || (best && !better(*thrown))) continue;
      best = thrown;
      take(*thrown);
    }
    return best.has_value();
  }

  std::optional<core::Target> throw_dots() {
    core::Target target;
    target.upright = request_.upright;
    while (target.dots.size() < request_.dots) {
      int attempt = 0;
      for (; attempt < kAttempts; ++attempt) {
        const Vector2d place{random_.uniform(-half_m_.x(), half_m_.x()),
                             random_.uniform(-half_m_.y(), half_m_.y())};
        if (has_room(target, on_grid(place), request_.dots)) {
          target.dots.push_back({on_grid(place), request_.diameter_m, Vector3d::UnitZ()});
          break;
        }
      }
      if (attempt == kAttempts) return std::nullopt;
    }
    return target;
  }

  Vector3d on_grid(const Vector2d& place) const {
    return {std::round(place.x() / grid_m_) * grid_m_, std::round(place.y() / grid_m_) * grid_m_,
            0.0};
  }

  // `but`: a dot that is to go there and is not in its own way.
  bool has_room(const core::Target& target, const Vector3d& place, std::size_t but) const {
    if (std::abs(place.x()) > half_m_.x() || std::abs(place.y()) > half_m_.y()) return false;
    for (std::size_t i = 0; i < target.dots.size(); ++i) {
      if (i != but && (target.dots[i].position_m - place).norm() < spacing_m_) return false;
    }
    return true;
  }

  static double inertia_m2(const core::Target& target) {
    const double sigma_rad =
        config::conditioning_of(target).attitude_deg_per_mm * 1e3 * std::numbers::pi / 180.0;
    return 1.0 / (sigma_rad * sigma_rad);
  }

  bool spread_well(const core::Target& target) const {
    const double side_m = 2.0 * half_m_.minCoeff();
    const double even_m2 = static_cast<double>(request_.dots) * side_m * side_m / 12.0;
    return inertia_m2(target) >= kLeastSpread * even_m2;
  }

  bool better(const core::Target& target) const {
    if (!worst_ && inertia_m2(target) <= merit_.inertia_m2) return false;
    config::RelabellingSearch search(target, 0.5 * request_.diameter_m);
    if (search.any(fewest_, merit_.misfit_m)) return false;
    return request_.dots == fewest_ || !search.any(request_.dots, merit_.misfit_m);
  }

  void take(const core::Target& target) {
    layout_ = target;
    config::RelabellingSearch search(target, 0.5 * request_.diameter_m);
    worst_ = search.least(fewest_, ample_m_).relabelling;
    merit_ = {worst_ ? worst_->total_m : ample_m_, inertia_m2(target)};
    if (request_.dots == fewest_) return;
    if (const auto all = search.least(request_.dots, merit_.misfit_m).relabelling) {
      worst_ = all;
      merit_.misfit_m = all->total_m;
    }
  }

  void improve(int step) {
    const double progress = static_cast<double>(step) / kImprovements;
    const double reach_m =
        short_side_m(request_.panel) * kFirstStep * std::pow(kLastStep / kFirstStep, progress);
    const std::size_t dot = dot_to_move();
    const Vector2d by{random_.uniform(-reach_m, reach_m), random_.uniform(-reach_m, reach_m)};
    core::Target moved = layout_;
    Vector3d& place = moved.dots[dot].position_m;
    place = on_grid(place.head<2>() + by);
    if (!has_room(moved, place, dot) || !spread_well(moved) || !better(moved)) return;
    take(moved);
  }

  std::size_t any_dot() {
    return std::min(
        static_cast<std::size_t>(random_.uniform() * static_cast<double>(request_.dots)),
        request_.dots - 1);
  }

  std::size_t dot_to_move() {
    const bool of_the_worst = worst_ && random_.uniform() < kWorstFirst;
    for (;;) {
      const std::size_t dot = any_dot();
      if (!of_the_worst || has_part(dot)) return dot;
    }
  }

  bool has_part(std::size_t dot) const {
    if (worst_->label[dot] != config::kLeftOut) return true;
    return std::find(worst_->label.begin(), worst_->label.end(), dot) != worst_->label.end();
  }

  DesignRequest request_;
  double spacing_m_;
  Vector2d half_m_;  // of the rectangle that the centres stay in
  double grid_m_;
  std::size_t fewest_;
  double ample_m_;  // a misfit
  RandomStream random_;
  core::Target layout_;
  std::optional<config::Relabelling> worst_;  // none where the misfit is ample
  Merit merit_;
};

}  // namespace

double suitable_diameter_m(std::size_t dots, const Panel& panel) {
  const double room_m = short_side_m(panel) / (5.0 * std::sqrt(static_cast<double>(dots)));
  const double rounded_m = std::floor(room_m * 1e3) * 1e-3;
  return std::min(kLargestDiameter_m, rounded_m > 0.0 ? rounded_m : room_m);
}

Result<core::Target> design_target(const DesignRequest& request) {
  DesignRequest full = request;
  if (full.diameter_m <= 0.0) full.diameter_m = suitable_diameter_m(full.dots, full.panel);
  const bool room = short_side_m(full.panel) > 2.0 * kMargin_diameters * full.diameter_m;
  if (auto target = room ? Designer(full).design() : std::nullopt) return *target;
  return fail(fmt::format(
      "{} dots of {:g} m have no room on a panel of {:g} x {:g} m; expected room for {:g} "
      "diameters "
      "from dot to dot and {:g} from dot to edge: a larger panel or a smaller --diameter",
      full.dots, full.diameter_m, full.panel.length_m, full.panel.width_m, kSpacing_diameters,
      kMargin_diameters));
}

}  // namespace dottrack::workstation
