#include "app/workstation/calibrate/fit/habits.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dottrack::calibrate {
namespace {

struct Habit {
  int first;
  int count;
  double least;  // of the loosest sigma: no camera is believed to be better
  bool own_mean;
};
constexpr Habit kHabits[] = {{kAspect, 1, 1e-3, false}, {kSkew, 1, 2.5e-2, false},
                             {kAxis, 2, 1e-2, false},   {kCentre, 2, 1e-3, false},
                             {kRadial, 1, 2e-3, true},  {kRadial + 1, 1, 2e-3, true}};
constexpr double kBelief = 1.0;          // numbers that are believed to be as off as assumed
constexpr std::size_t kFewestAlike = 4;  // cameras that a common mean is learnt from

// One number of one camera.
struct Member {
  AdjustedCamera* camera;
  std::size_t number;
  double told;  // the part of it that the data tell, 0 to 1

  double value() const { return camera->camera.numbers[number]; }
  double& mean() const { return camera->priors.mean[number]; }
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
      const double told = 1.0 - information.cameras[i](k, k) / (sigma * sigma);
      out.push_back({&c, static_cast<std::size_t>(k), std::max(told, 0.0)});
    }
  }
  return out;
}

void learn_mean(const std::vector<Member>& all) {
  double sum = 0.0;
  double weight = 0.0;
  for (const Member& m : all) {
    sum += m.told * m.value();
    weight += m.told;
  }
  if (!(weight > 0.0)) return;
  for (const Member& m : all) m.mean() = sum / weight;
}

double learn(Adjustment& adjustment, const Information& information, const Habit& habit) {
  const std::vector<Member> all = members(adjustment, information, habit);
  double told = kBelief;
  if (habit.own_mean) {
    if (all.size() < kFewestAlike) return 0.0;
    learn_mean(all);
    told -= 1.0;  // the mean takes one
  }
  double square = kBelief;
  for (const Member& m : all) {
    const double off = (m.value() - m.mean()) / m.sigma();
    square += off * off;
    told += m.told;
  }
  const double factor = std::sqrt(square / std::max(told, 0.1 * kBelief));
  double change = 0.0;
  for (const Member& m : all) {
    const double before = m.sigma();
    m.sigma() = std::clamp(before * factor, habit.least * m.loosest(), m.loosest());
    change = std::max(change, std::abs(std::log(m.sigma() / before)));
  }
  return change;
}

}  // namespace

double learn_habits(Adjustment& adjustment, const Information& information) {
  double change = 0.0;
  for (const Habit& habit : kHabits) {
    change = std::max(change, learn(adjustment, information, habit));
  }
  return change;
}

}  // namespace dottrack::calibrate
