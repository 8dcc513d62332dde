#include "app/workstation/target/target_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/config/target_admission.h"

namespace dottrack::workstation {
namespace {

using config::LeastMisfit;
using config::TargetJudgement;
using Names = std::span<const std::string>;

std::string row(std::string_view name, std::string_view text) {
  return fmt::format("{:<14}{}\n", name, text);
}

std::string distances(const core::Target& target) {
  double smallest_m = std::numeric_limits<double>::infinity();
  double largest_m = 0.0;
  for (std::size_t i = 0; i < target.dots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_m = (target.dots[i].position_m - target.dots[j].position_m).norm();
      smallest_m = std::min(smallest_m, apart_m);
      largest_m = std::max(largest_m, apart_m);
    }
  }
  return fmt::format("{:.4g} to {:.4g} m", smallest_m, largest_m);
}

// One line of the worst relabelling of so many dots, or that none is near.
std::string relabelling_row(const TargetJudgement& judgement, const LeastMisfit& least,
                            std::size_t dots, Names names) {
  const double per_dot = std::sqrt(static_cast<double>(dots));
  const double needed_m = judgement.needed_m();
  const double total_m = least.relabelling ? least.relabelling->total_m : least.searched_m;
  const char* above = least.relabelling ? "" : ">";
  return fmt::format("{:<14}{:>10} {:>10} {:>8}{}\n",
                     dots == judgement.target_dots ? fmt::format("all {} dots", dots)
                                                   : fmt::format("{} dots", dots),
                     fmt::format("{}{:.1f} mm", above, total_m / per_dot * 1e3),
                     fmt::format("{:.1f} mm", needed_m / per_dot * 1e3),
                     fmt::format("{}{:.2f}", above, total_m / needed_m),
                     least.relabelling ? "  " + config::describe(*least.relabelling, names) : "");
}

std::string ambiguity(const core::Target& target, const TargetJudgement& judgement, Names names) {
  const auto moves = config::moves_to_tell_apart(target, judgement.sigma_m);
  return "ambiguous: " +
         (moves.empty() ? "place the dots without symmetry" : config::describe(moves, names));
}

std::string verdict(const core::Target& target, const TargetJudgement& judgement, Names names) {
  if (judgement.ambiguous()) return ambiguity(target, judgement, names);
  if (!judgement.well_conditioned()) {
    return fmt::format(
        "badly conditioned: place the dots farther apart, or farther from one line; {:g} degrees "
        "or better are needed",
        config::kMostAttitude_deg);
  }
  if (!judgement.complete) return "not judged: too many dots look alike to try all relabellings";
  const std::size_t needed = judgement.dots_needed();
  if (!judgement.most) {
    return fmt::format("good: no {} of its dots can be mistaken for others", needed);
  }
  return fmt::format("good while {} of its {} dots are seen: {} can be mistaken for others",
                     needed == judgement.target_dots ? "all" : fmt::format("any {}", needed),
                     judgement.target_dots, judgement.most->dots);
}

}  // namespace

bool good(const TargetJudgement& judgement) {
  return judgement.complete && judgement.well_conditioned() && !judgement.ambiguous();
}

std::string target_table(const core::Target& target, const TargetJudgement& judgement,
                         Names names) {
  const config::Conditioning& pose = judgement.conditioning;
  std::string text;
  text += row("dots",
              fmt::format("{}, {}, their places known to {:.2g} mm", target.dots.size(),
                          target.upright ? "upright" : "in any attitude", judgement.sigma_m * 1e3));
  text += row("distances", distances(target));
  text += row("attitude", fmt::format("{:.2f} degrees about the worst axis ({:.3f} a mm)",
                                      pose.attitude_deg_per_mm * judgement.sigma_m * 1e3,
                                      pose.attitude_deg_per_mm));
  text += row("position", fmt::format("of the origin {:.2f} mm along the worst axis ({:.3f} a mm)",
                                      pose.position_mm_per_mm * judgement.sigma_m * 1e3,
                                      pose.position_mm_per_mm));
  text += fmt::format("{:<14}{:>10} {:>10} {:>8}\n", "relabelled", "misfit", "needed", "ratio");
  text += relabelling_row(judgement, judgement.all, judgement.target_dots, names);
  if (judgement.target_dots > config::kFewestDots) {
    text += relabelling_row(judgement, judgement.few, config::kFewestDots, names);
  }
  return text + verdict(target, judgement, names) + "\n";
}

}  // namespace dottrack::workstation
