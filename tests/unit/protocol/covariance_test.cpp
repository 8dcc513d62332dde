// The covariance as a reader of the bus has it, against the true one.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

constexpr std::array<const char*, 6> kAxes{"X", "Y", "Z", "Roll", "Pitch", "Yaw"};
constexpr std::array<const char*, 15> kCorrelationMessages{
    "Correlation1", "Correlation1", "Correlation1", "Correlation1", "Correlation1",
    "Correlation2", "Correlation2", "Correlation2", "Correlation2", "Correlation2",
    "Correlation3", "Correlation3", "Correlation3", "Correlation3", "Correlation3"};

struct Sent {
  bool available = true;
  int not_available = 0;  // of the 21 numbers
  Vector6 sigmas;
  Matrix6 covariance;
};

std::string sigma_name(bool is_fd, std::size_t i) {
  const std::string message = is_fd ? "FdPose" : i < 3 ? "SigmaPosition" : "SigmaAttitude";
  return message + ".Sigma" + kAxes.at(i);
}

Sent read_covariance(const Reading& reading, bool is_fd) {
  Sent sent;
  Matrix6 correlations = Matrix6::Identity();
  std::size_t next = 0;
  const auto take = [&](const std::string& name) {
    sent.not_available += reading.available(name) ? 0 : 1;
    return reading(name);
  };
  for (std::size_t i = 0; i < 6; ++i) {
    sent.sigmas[static_cast<int>(i)] = take(sigma_name(is_fd, i));
    for (std::size_t j = i + 1; j < 6; ++j) {
      const std::string message = is_fd ? "FdPose" : kCorrelationMessages.at(next);
      ++next;
      const double value = take(message + ".Corr" + kAxes.at(i) + kAxes.at(j));
      correlations(static_cast<int>(i), static_cast<int>(j)) = value;
      correlations(static_cast<int>(j), static_cast<int>(i)) = value;
    }
  }
  sent.available = sent.not_available == 0;
  sent.covariance = sent.sigmas.asDiagonal() * correlations * sent.sigmas.asDiagonal();
  return sent;
}

PoseMessage with_covariance(const Matrix6& covariance) {
  PoseMessage message;
  message.pose_valid = true;
  message.covariance = covariance;
  return message;
}

Sent send(const Matrix6& covariance, bool is_fd) {
  const GroupParts parts{.covariance = true, .motion = false, .cameras = false, .dots = false};
  return read_covariance(
      Reading(encoded(with_covariance(covariance), is_fd ? fd() : classic(), parts)), is_fd);
}

double least_eigenvalue(const Matrix6& m) {
  return Eigen::SelfAdjointEigenSolver<Matrix6>(m, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

// In units of the sigmas as sent, so that a small axis counts like a large one.
Matrix6 in_sigmas(const Matrix6& m, const Vector6& sigmas) {
  const Vector6 inverse = sigmas.cwiseInverse();
  return inverse.asDiagonal() * m * inverse.asDiagonal();
}

class Covariance : public testing::TestWithParam<bool> {
 protected:
  bool is_fd() const { return GetParam(); }
  double half_step() const { return is_fd() ? 0.008 : 0.002; }

  // What is wrong with what was sent; nothing: "".
  std::string fault(const Matrix6& truth, const Sent& sent) const {
    if (!sent.available) return "not available";
    if (least_eigenvalue(in_sigmas(sent.covariance - truth, sent.sigmas)) < -1e-12) {
      return "understated";
    }
    if (least_eigenvalue(in_sigmas(sent.covariance, sent.sigmas)) < -1e-12) return "indefinite";
    const Vector6 bound =
        (1.0 + 5.0 * half_step()) * sent.sigmas.cwiseAbs2() - truth.diagonal() * (1.0 - 1e-9);
    const Matrix6 over = Matrix6(bound.asDiagonal()) - (sent.covariance - truth);
    return least_eigenvalue(in_sigmas(over, sent.sigmas)) < -1e-9 ? "overstated" : "";
  }
};

TEST_P(Covariance, AsSentIsNeverBelowTheTrueOneAndNotFarAboveIt) {
  std::mt19937_64 random(1);
  int singular = 0;
  int tight = 0;
  const double margin = 0.6 * 5.0 * half_step();
  for (int i = 0; i < 20000; ++i) {
    const Matrix6 truth = random_covariance(random);
    const Sent sent = send(truth, is_fd());
    ASSERT_EQ(fault(truth, sent), "") << i << "\n" << truth;
    const Vector6 sigmas = truth.diagonal().cwiseSqrt();
    singular += least_eigenvalue(in_sigmas(truth, sigmas)) < 1e-9 ? 1 : 0;
    tight += least_eigenvalue(in_sigmas(sent.covariance - truth, sent.sigmas)) < margin ? 1 : 0;
  }
  EXPECT_GT(singular, 5000);
  EXPECT_GT(tight, 20);  // roundings do use up the margin
}

TEST_P(Covariance, CostsAFewPercentOfTheVariances) {
  const double most = is_fd() ? 0.084 : 0.021;
  std::mt19937_64 random(2);
  const Vector6 sigmas = Vector6::Constant(0.2);  // a step up is nothing here
  for (int i = 0; i < 5000; ++i) {
    const Matrix6 truth = scaled_covariance(random_correlations(random, 1 + i % 8, 3.0), sigmas);
    const Sent sent = send(truth, is_fd());
    ASSERT_TRUE(sent.available);
    const Matrix6 over = in_sigmas(sent.covariance - truth, sigmas);
    ASSERT_LT(-least_eigenvalue(-over), most + 2e-4);
  }
}

TEST_P(Covariance, SigmasAreTheTrueOnesRoundedUp) {
  const double factor = is_fd() ? 1.021 : 1.0051;
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Matrix6 truth = random_covariance(random);
    const Sent sent = send(truth, is_fd());
    for (int k = 0; k < 6; ++k) {
      const double sigma = std::sqrt(truth(k, k));
      ASSERT_GE(sent.sigmas[k], sigma);
      ASSERT_LE(sent.sigmas[k], sigma * factor + 5.001e-6);
    }
  }
}

TEST_P(Covariance, PerfectCorrelationOfEitherSignIsSent) {
  for (unsigned signs = 0; signs < 64; ++signs) {
    Vector6 v;
    for (int k = 0; k < 6; ++k) v[k] = ((signs >> k) & 1U) != 0 ? 0.01 : -0.02;
    const Matrix6 truth = v * v.transpose();
    ASSERT_EQ(fault(truth, send(truth, is_fd())), "") << signs;
  }
}

TEST_P(Covariance, ASigmaBeyondItsRangeMakesAllOfItNotAvailable) {
  const double inflation = is_fd() ? 1.0208334 : 1.0050506;
  for (int k = 0; k < 6; ++k) {
    Matrix6 fits = Matrix6::Identity() * 1e-6;
    fits(k, k) = std::pow(0.32766 / inflation, 2);
    EXPECT_EQ(fault(fits, send(fits, is_fd())), "");
    Matrix6 beyond = fits;
    for (const double sigma : {0.327671 / inflation, 0.33, 1.0, 1e10, 1e160}) {
      beyond(k, k) = sigma * sigma;
      EXPECT_EQ(send(beyond, is_fd()).not_available, 21) << sigma;
    }
  }
}

std::vector<Matrix6> no_covariances() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const Matrix6 good = Matrix6::Identity() * 1e-6;
  std::vector<Matrix6> bad{Matrix6::Zero(), -good};
  for (int i = 0; i < 6; ++i) {
    for (const double variance : {0.0, -1e-300, -1e-6}) bad.emplace_back(good)(i, i) = variance;
    for (int j = 0; j < 6; ++j) {
      for (const double value : {kNaN, kInf, -kInf, 1e300, -1e300}) {
        bad.emplace_back(good)(i, j) = value;
        bad.back()(j, i) = value;
      }
      if (i == j) continue;
      for (const double value : {kNaN, kInf, 1e-14}) bad.emplace_back(good)(i, j) = value;
      bad.emplace_back(good)(i, j) = 1.1e-6;  // a correlation beyond 1
      bad.back()(j, i) = 1.1e-6;
    }
  }
  // Each two are correlated as far as can be, but not all three of them so: indefinite.
  for (int i = 0; i < 6; ++i) {
    Matrix6 m = good;
    const int j = (i + 1) % 6;
    const int k = (i + 2) % 6;
    m(i, j) = m(j, i) = m(i, k) = m(k, i) = 0.9e-6;
    m(j, k) = m(k, j) = -0.9e-6;
    bad.push_back(m);
  }
  return bad;
}

TEST_P(Covariance, WhatIsNoneIsNotAvailableAndSaidToBeUnknown) {
  const std::string degraded = is_fd() ? "FdPose.Degraded" : "Quality.Degraded";
  const auto unknown = std::int64_t{1} << static_cast<unsigned>(Degraded::covariance_unknown);
  int refused = 0;
  for (const Matrix6& m : no_covariances()) {
    const GroupParts parts{.covariance = true, .motion = false, .cameras = false, .dots = false};
    const Reading reading(encoded(with_covariance(m), is_fd() ? fd() : classic(), parts));
    ASSERT_EQ(read_covariance(reading, is_fd()).not_available, 21) << m;
    ASSERT_EQ(reading.raw(degraded), unknown);
    ++refused;
  }
  EXPECT_GT(refused, 300);
}

TEST_P(Covariance, NearlyNoneForRoundingsSakeIsStillSent) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vector6 v = random_normal6(random) * 0.01;
    Matrix6 truth = v * v.transpose();
    truth(static_cast<int>(random() % 6), static_cast<int>(random() % 6)) *= 1.0 - 1e-13;
    ASSERT_EQ(fault(0.5 * (truth + truth.transpose()), send(truth, is_fd())), "");
  }
}

INSTANTIATE_TEST_SUITE_P(ClassicAndFd, Covariance, testing::Values(false, true));

}  // namespace
}  // namespace dottrack::protocol::test
