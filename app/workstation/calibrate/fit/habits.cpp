#include "app/workstation/calibrate/fit/habits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dottrack::calibrate {
namespace {

struct Habit {
  int first;
  int count;
  double least;  // of the loosest sigma: no camera is believed to be better
};
constexpr Habit kHabits[] = {{kAspect, 1, 1e-3}, {kSkew, 1, 2.5e-2}, {kAxis, 2, 1e-2},
                             {kCentre, 2, 1e-3}, {kRadial, 1, 2e-4}, {kRadial + 1, 1, 2e-4}};
constexpr double kBelief = 1.0;          // numbers that are believed to be as off as assumed
constexpr std::size_t kFewestAlike = 4;  // cameras that a common lens is learnt from

bool is_radial(int number) {
  return number >= kRadial && number < kRadial + kRadialTerms;
}

// One number of one camera.
struct Member {
  AdjustedCamera* camera;
  std::size_t number;
  double mean;
  double told;  // the part of its distance from the mean that the data tell, 0 to 1

  double value() const { return camera->camera.numbers[number]; }
  double& sigma() const { return camera->priors.sigma[number]; }
  double loosest() const { return camera->priors.loosest[number]; }
};

std::vector<Member> members(Adjustment& adjustment, const Information& information,
                            const Habit& habit) {
  std::vector<Member> out;
  for (std::size_t i = 0; i < adjustment.cameras.size(); ++i) {
    AdjustedCamera& c = adjustment.cameras[i];
    for (int k = habit.first; k < habit.first + habit.count; ++k) {
      const double sigma = c.priors.sigma[static_cast<std::size_t>(k)];
      if (!is_free(c.camera.kind, k) || !(sigma > 0.0)) continue;
      double mean = 0.0;
      double variance = information.cameras[i](k, k);
      if (is_radial(k)) {
        mean = adjustment.lens.radial[static_cast<std::size_t>(k - kRadial)];
        variance = information.off_lens[i][k - kRadial];
      }
      const double told = 1.0 - variance / (sigma * sigma);
      out.push_back({&c, static_cast<std::size_t>(k), mean, std::max(told, 0.0)});
    }
  }
  return out;
}

double learn(Adjustment& adjustment, const Information& information, const Habit& habit) {
  const std::vector<Member> all = members(adjustment, information, habit);
  double told = kBelief;
  double square = kBelief;
  for (const Member& m : all) {
    const double off = (m.value() - m.mean) / m.sigma();
    square += off * off;
    told += m.told;
  }
  const double factor = std::sqrt(square / told);
  double change = 0.0;
  for (const Member& m : all) {
    const double before = m.sigma();
    m.sigma() = std::clamp(before * factor, habit.least * m.loosest(), m.loosest());
    change = std::max(change, std::abs(std::log(m.sigma() / before)));
  }
  return change;
}

// Of the cameras whose lens bends; their mean is where the common lens starts from.
bool found_lens(Adjustment& adjustment) {
  std::array<double, kRadialTerms> sum{};
  std::array<std::size_t, kRadialTerms> count{};
  for (const AdjustedCamera& c : adjustment.cameras) {
    for (std::size_t k = 0; k < kRadialTerms; ++k) {
      if (!is_free(c.camera.kind, kRadial + static_cast<int>(k))) continue;
      sum[k] += c.camera.numbers[kRadial + k];
      ++count[k];
    }
  }
  if (count[0] < kFewestAlike) return false;
  for (std::size_t k = 0; k < kRadialTerms; ++k) {
    adjustment.lens.radial[k] = count[k] > 0 ? sum[k] / static_cast<double>(count[k]) : 0.0;
  }
  adjustment.lens.exists = true;
  return true;
}

}  // namespace

double learn_habits(Adjustment& adjustment, const Information& information) {
  // Its next solution is the first that knows it.
  if (!adjustment.lens.exists && found_lens(adjustment)) return 1.0;
  double change = 0.0;
  for (const Habit& habit : kHabits) {
    if (is_radial(habit.first) && !adjustment.lens.exists) continue;
    change = std::max(change, learn(adjustment, information, habit));
  }
  return change;
}

}  // namespace dottrack::calibrate
