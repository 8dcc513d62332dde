// The smallest moves of dots that tell a target from itself.

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "app/config/target_judgement.h"
#include "app/config/target_shape.h"

namespace dottrack::config {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kDirections = 12;
constexpr double kFirstStep = 2.0;  // standard deviations of a dot's place
constexpr double kStepGrowth = 1.15;
constexpr int kSteps = 26;  // up to 65 standard deviations
constexpr std::size_t kMostMoves = 3;
constexpr int kPrepareStep = 16;  // of the steps: how far a dot moves that is not enough alone
constexpr double kGrid_m = 1e-4;

Vector3d plane_normal(const core::Target& target, std::size_t dot) {
  if (target.dots[dot].normal) return *target.dots[dot].normal;
  const auto count = static_cast<double>(target.dots.size());
  Vector3d mean = Vector3d::Zero();
  for (const core::TargetDot& other : target.dots) mean += other.position_m / count;
  Matrix3d scatter = Matrix3d::Zero();
  for (const core::TargetDot& other : target.dots) {
    scatter += (other.position_m - mean) * (other.position_m - mean).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(scatter).eigenvectors().col(0);
}

Vector3d on_grid(const Vector3d& p) {
  return (p / kGrid_m).array().round() * kGrid_m;
}

class Adviser {
 public:
  Adviser(const core::Target& target, double sigma_m) : target_(target), sigma_m_(sigma_m) {}

  std::vector<DotMove> advise() {
    std::vector<DotMove> moves;
    while (moves.size() < kMostMoves) {
      if (const auto last = last_move()) {
        moves.push_back(*last);
        return moves;
      }
      const auto helpful = helpful_move();
      if (!helpful) break;
      moves.push_back(*helpful);
      target_.dots[helpful->dot].position_m = helpful->to_m;
    }
    return {};
  }

 private:
  template <class Visit>
  bool for_each_move(int step, const Visit& visit) const {
    const double by_m = sigma_m_ * kFirstStep * std::pow(kStepGrowth, step);
    for (std::size_t dot = 0; dot < target_.dots.size(); ++dot) {
      const Vector3d normal = plane_normal(target_, dot);
      const Vector3d ahead =
          Vector3d(std::abs(normal.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY());
      const Vector3d u = (ahead - ahead.dot(normal) * normal).normalized();
      const Vector3d v = normal.cross(u);
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kDirections;
        const Vector3d from = target_.dots[dot].position_m;
        const Vector3d to = on_grid(from + by_m * (std::cos(angle) * u + std::sin(angle) * v));
        if (visit(DotMove{dot, to, (to - from).norm()})) return true;
      }
    }
    return false;
  }

  // After which nothing is left to mistake.
  std::optional<DotMove> last_move() const {
    std::optional<DotMove> found;
    for (int step = 0; step < kSteps && !found; ++step) {
      for_each_move(step, [&](const DotMove& move) {
        if (!ambiguous_after(move)) found = move;
        return found.has_value();
      });
    }
    return found;
  }

  // After which the worst relabelling misfits most.
  std::optional<DotMove> helpful_move() const {
    std::optional<DotMove> best;
    double most_m = -1.0;
    for_each_move(kPrepareStep, [&](const DotMove& move) {
      const core::Target moved = target_after(move);
      if (faulty(moved)) return false;
      RelabellingSearch search(moved, kNoticeable * sigma_m_);
      const LeastMisfit least = search.least(moved.dots.size(), kTellApart * sigma_m_);
      if (least.relabelling && least.relabelling->total_m > most_m) {
        best = move;
        most_m = least.relabelling->total_m;
      }
      return false;
    });
    return best;
  }

  core::Target target_after(const DotMove& move) const {
    core::Target moved = target_;
    moved.dots[move.dot].position_m = move.to_m;
    return moved;
  }

  static bool faulty(const core::Target& target) {
    const std::vector<std::string> names(target.dots.size());
    return find_shape_fault(as_span(target.dots), names).has_value();
  }

  bool ambiguous_after(const DotMove& move) const {
    const core::Target moved = target_after(move);
    if (faulty(moved)) return true;
    RelabellingSearch search(moved, kNoticeable * sigma_m_);
    return search.any(moved.dots.size(), kTellApart * sigma_m_) || !search.complete();
  }

  core::Target target_;
  double sigma_m_;
};

}  // namespace

std::vector<DotMove> moves_to_tell_apart(const core::Target& target, double sigma_m) {
  return Adviser(target, sigma_m).advise();
}

}  // namespace dottrack::config
