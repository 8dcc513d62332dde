#pragma once
// Compares what false-lock probabilities claim with how often the selections are wrong, and prints
// both as a table.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include "tests/unit/acquisition/finalist_scenes.h"

namespace dottrack::acquisition::test {

inline constexpr double kLimit_m = 0.02;
inline constexpr int kEnough = 30;  // wrong ones, claimed or observed, to compare two rates by

struct Tally {
  double candidates = 0.0;
  double claimed = 0.0;  // sum of the probabilities
  double wrong = 0.0;

  void add(double probability, bool is_wrong) {
    candidates += 1.0;
    claimed += probability;
    wrong += is_wrong ? 1.0 : 0.0;
  }
};

class Calibration {
 public:
  void add(const std::string& row, double probability, bool wrong) {
    rows_[row].add(probability, wrong);
  }
  // Within a factor of two wherever there are enough to say so.
  int check() const {
    int compared = 0;
    std::printf("| | candidates | wrong, claimed | wrong, observed | claimed / observed |\n");
    std::printf("|---|---|---|---|---|\n");
    for (const auto& [row, t] : rows_) {
      std::printf("| %s | %.0f | %.3g | %.0f | ", row.c_str(), t.candidates, t.claimed, t.wrong);
      if (std::max(t.claimed, t.wrong) < kEnough) {
        std::printf("- |\n");
        continue;
      }
      std::printf("%.2f |\n", t.claimed / t.wrong);
      EXPECT_LT(t.claimed, 2.0 * t.wrong) << row;
      EXPECT_GT(t.claimed, 0.5 * t.wrong) << row;
      ++compared;
    }
    return compared;
  }
  const Tally& row(const std::string& name) const { return rows_.at(name); }

 private:
  std::map<std::string, Tally> rows_;
};

inline const char* name_of(ClutterKind kind) {
  switch (kind) {
    case ClutterKind::everywhere:
      return "clutter everywhere";
    case ClutterKind::on_the_floor:
      return "clutter on the floor";
    case ClutterKind::in_clusters:
      return "clutter in clusters";
  }
  return "";
}

inline std::string decade_of(double probability) {
  if (probability < 1e-6) return "probability below 1e-6";
  int decade = 1;
  while (decade < 6 && probability < std::pow(10.0, -decade)) ++decade;
  return "probability from 1e-" + std::to_string(decade);
}

inline bool is_wrong(const FinalistScene& scene, const CandidateLock& lock) {
  return !scene.truth || !same_place(scene.target, *scene.truth, lock.pose);
}

struct Mix {
  std::uint64_t seed;
  int scenes;
  std::array<std::size_t, 8> dots;
  // Above 0: nothing is known but finalists of so many views, as in the first part of a search.
  // Dots are seen by more cameras then.
  std::size_t least_views = 0;
};

inline Calibration calibrate(const Mix& mix) {
  Calibration calibration;
  SceneMaker make(mix.seed, mix.least_views > 0 ? 2 : 0);
  Finder finder;
  for (int i = 0; i < mix.scenes; ++i) {
    const auto kind = static_cast<ClutterKind>(i % 3);
    const std::size_t dots = mix.dots[static_cast<std::size_t>(i / 3) % mix.dots.size()];
    FinalistScene scene = make.scene(kind, dots);
    std::erase_if(scene.finalists, [&](const Finalist& f) {
      return static_cast<std::size_t>(f.cameras.size()) < mix.least_views;
    });
    const auto lock = finder.find(scene, kLimit_m, mix.least_views == 0);
    if (!lock) continue;
    const double p = false_lock_probability(lock->log_odds, as_span(lock->rivals));
    const bool wrong = is_wrong(scene, *lock);
    calibration.add("all", p, wrong);
    calibration.add(name_of(kind), p, wrong);
    calibration.add(std::to_string(lock->witnesses.size()) + " dots matched", p, wrong);
    calibration.add(decade_of(p), p, wrong);
  }
  return calibration;
}

}  // namespace dottrack::acquisition::test
