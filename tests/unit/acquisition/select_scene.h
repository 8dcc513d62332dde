#pragma once
// Random targets, and candidates to find them among: noisy, missing, mirrored, with exact ties.

#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

#include "app/core/acquisition/select.h"

namespace dottrack::acquisition::test {

class SelectScene {
 public:
  explicit SelectScene(unsigned seed) : random_(seed) {}

  core::Target target(std::size_t n, bool upright) {
    core::Target t;
    t.upright = upright;
    for (std::size_t i = 0; i < n; ++i) t.dots.push_back({vector({0.5, 0.4, 0.1}), 0.1, {}});
    return t;
  }

  // Its dots are corners of a coarse grid: many edges are equal.
  core::Target grid_target(std::size_t n, bool upright) {
    core::Target t;
    t.upright = upright;
    for (const DotCandidate& corner : grid(n)) t.dots.push_back({corner.position_m, 0.1, {}});
    return t;
  }

  // The target's dots, turned by `turn` and moved somewhere, with noise.
  std::vector<DotCandidate> image(const core::Target& target, const Eigen::Matrix3d& turn,
                                  double noise_m) {
    const Eigen::Vector3d place = vector({3.0, 3.0, 0.3});
    std::vector<DotCandidate> candidates;
    for (const core::TargetDot& dot : target.dots) {
      const Eigen::Vector3d error = vector(Eigen::Vector3d::Constant(noise_m));
      candidates.push_back(
          {turn * dot.position_m + place + error, dot.diameter_m + uniform(-noise_m, noise_m)});
    }
    return candidates;
  }

  Eigen::Matrix3d upright_turn() { return turn(uniform(-3.0, 3.0), Eigen::Vector3d::UnitZ()); }
  Eigen::Matrix3d upside_down_turn() {
    return turn(3.14159265358979, Eigen::Vector3d::UnitX()) * upright_turn();
  }
  static Eigen::Matrix3d mirror() { return Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal(); }

  // Candidates of about the dots' size around the first one.
  void add_clutter(std::size_t count, std::vector<DotCandidate>& candidates) {
    const Eigen::Vector3d place =
        candidates.empty() ? Eigen::Vector3d::Zero().eval() : candidates.front().position_m;
    for (std::size_t i = 0; i < count; ++i) {
      candidates.push_back({place + vector({0.8, 0.8, 0.3}), 0.1 + uniform(-0.03, 0.03)});
    }
  }

  // The target's dots, moved upright somewhere, with noise; then clutter around them.
  std::vector<DotCandidate> scene(const core::Target& target, std::size_t clutter, double noise_m) {
    auto candidates = image(target, upright_turn(), noise_m);
    add_clutter(clutter, candidates);
    shuffle(candidates);
    return candidates;
  }

  // Candidates on a coarse grid, some of them at the same corner.
  std::vector<DotCandidate> grid(std::size_t n) {
    std::vector<DotCandidate> candidates;
    std::uniform_int_distribution<int> step(0, 3);
    for (std::size_t i = 0; i < n; ++i) {
      candidates.push_back(
          {0.25 * Eigen::Vector3d(step(random_), step(random_), step(random_)), 0.1});
    }
    return candidates;
  }

  void shuffle(std::vector<DotCandidate>& candidates) {
    std::shuffle(candidates.begin(), candidates.end(), random_);
  }
  std::size_t integer(std::size_t least, std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(least, most)(random_);
  }
  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  Eigen::Vector3d vector(const Eigen::Vector3d& reach) {
    const double x = uniform(-reach.x(), reach.x());
    const double y = uniform(-reach.y(), reach.y());
    return {x, y, uniform(-reach.z(), reach.z())};
  }

 private:
  static Eigen::Matrix3d turn(double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  }

  std::mt19937 random_;
};

}  // namespace dottrack::acquisition::test
