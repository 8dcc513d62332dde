#pragma once
// What an adjustment knows at its optimum: covariances of cameras and dots, and how each residual
// compares with what it may be.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/workstation/calibrate/fit/adjustment.h"

namespace dottrack::calibrate {

// A residual in units of its sigma, with its covariance in the same units: that of the residual of
// what was used, that of the prediction's error of what was not.
template <int N>
struct Judged {
  Eigen::Matrix<double, N, 1> residual = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> covariance = Eigen::Matrix<double, N, N>::Identity();
  bool known = false;  // whether there is a prediction

  double redundancy() const { return covariance.trace(); }  // of what was used
};

struct Information {
  // Of the numbers of each camera, its zero rows those that are not free.
  std::vector<Eigen::Matrix<double, kNumbers, kNumbers>> cameras;
  // Of all cameras' numbers together, camera after camera: all rest on the same survey.
  Eigen::MatrixXd together;
  std::vector<Eigen::Matrix3d> dots;  // of their positions, square metres
  // Variances of how far each camera's radial terms are from the common lens's; zero where they
  // are on their own.
  std::vector<Eigen::Vector2d> off_lens;
  std::vector<Judged<2>> views;  // in the adjustment's order
  std::vector<Judged<3>> surveys;
};

// Nothing where the numbers are not determined. Sigmas are those that the adjustment assumes.
std::optional<Information> inform(const Adjustment& adjustment);

}  // namespace dottrack::calibrate
