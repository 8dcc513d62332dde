#include "app/config/model_correlation.h"

#include <algorithm>
#include <cmath>

namespace dottrack::config {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Of = const JointCovariance::Camera*;

constexpr double kSame = 1e-6;  // of the sigmas' product: the files round

bool is_same(const MatrixXd& a, const MatrixXd& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return false;
  const Eigen::VectorXd sigmas = a.diagonal().cwiseMax(0.0).cwiseSqrt();
  return ((a - b).cwiseAbs().array() <= kSame * (sigmas * sigmas.transpose()).array()).all();
}

void correlate_two(const MatrixXd& correlation, std::size_t a, std::size_t b,
                   core::ModelCorrelations& correlations) {
  for (Index i = 0; i < correlation.rows(); ++i) {
    for (Index j = 0; j < correlation.cols(); ++j) {
      correlations.set({a, static_cast<std::size_t>(i)}, {b, static_cast<std::size_t>(j)},
                       correlation(i, j));
    }
  }
}

}  // namespace

std::vector<std::size_t> correlate(const JointCovariance& joint, std::span<const std::string> names,
                                   std::span<const ModelReading> readings,
                                   core::ModelCorrelations& correlations) {
  std::vector<std::size_t> strangers;
  std::vector<Of> of;
  for (std::size_t i = 0; i < names.size(); ++i) {
    of.push_back(joint.find(names[i]));
    if (of[i] != nullptr && !is_same(readings[i].covariance, joint.block(*of[i], *of[i]))) {
      of[i] = nullptr;
    }
    if (of[i] == nullptr) strangers.push_back(i);
  }
  for (std::size_t a = 0; a < of.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (of[a] == nullptr || of[b] == nullptr) continue;
      const MatrixXd correlation =
          readings[a].of_vectors * joint.block(*of[a], *of[b]) * readings[b].of_vectors.transpose();
      correlate_two(correlation, a, b, correlations);
    }
  }
  return strangers;
}

}  // namespace dottrack::config
