#include "app/workstation/calibrate/labelling/disc_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dottrack::calibrate {
namespace {

constexpr double kEdge_px = 0.25;  // of the logistic edge
constexpr int kAround_px = 4;      // beyond the rim
constexpr int kMaxReach_px = 60;
constexpr double kOffEven_dn = 6.0;    // what counts half, at least
constexpr double kOffEvenPart = 0.08;  // and of the contrast
constexpr int kMaxSteps = 25;
constexpr double kMostOff = 0.5;        // of the centre, in semi-minor axes, and half a pixel
constexpr double kMostStretch = 1.7;    // of an axis
constexpr double kLeastContrast = 0.3;  // of the start's

constexpr int kUnknowns = 9;  // x, y, contrast, Qxx, Qxy, Qyy, surround, its slopes
using Numbers = Eigen::Matrix<double, kUnknowns, 1>;
using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;

class Patch {
 public:
  Patch(const ImageView& image, int x, int y, int reach, double off_even_dn)
      : image_(image), x_(x), y_(y), reach_(reach), off2_(off_even_dn * off_even_dn) {}

  // Sum of what the robust loss makes of the differences; infinite for no ellipse.
  double cost(const Numbers& n) const {
    double sum = 0.0;
    const bool ellipse = visit(
        n, [&](double off, const Numbers*) { sum += off2_ * std::log1p(off * off / off2_); },
        false);
    return ellipse ? sum : std::numeric_limits<double>::infinity();
  }

  void linearise(const Numbers& n, Normal& normal, Numbers& gradient) const {
    normal.setZero();
    gradient.setZero();
    visit(
        n,
        [&](double off, const Numbers* slope) {
          const double weight = 1.0 / (1.0 + off * off / off2_);
          normal.selfadjointView<Eigen::Lower>().rankUpdate(*slope, weight);
          gradient += weight * off * *slope;
        },
        true);
    normal.triangularView<Eigen::StrictlyUpper>() = normal.transpose();
  }

  double pixels() const { return (2.0 * reach_ + 1.0) * (2.0 * reach_ + 1.0); }

 private:
  template <class Take>
  bool visit(const Numbers& n, Take take, bool with_slopes) const {
    const double det = n[3] * n[5] - n[4] * n[4];
    if (!(det > 1e-9) || !(n[3] > 0.0)) return false;
    const double steep = std::pow(det, -0.25) / kEdge_px;  // mean radius over edge
    Numbers slope;
    for (int row = -reach_; row <= reach_; ++row) {
      const std::uint8_t* const pixels = image_.row(y_ + row) + x_;
      for (int column = -reach_; column <= reach_; ++column) {
        const double dx = column - n[0];
        const double dy = row - n[1];
        const double ax = n[3] * dx + n[4] * dy;
        const double ay = n[4] * dx + n[5] * dy;
        const double rho = std::sqrt(std::max(ax * dx + ay * dy, 1e-9));
        const double inside = 1.0 / (1.0 + std::exp(std::clamp((rho - 1.0) * steep, -30.0, 30.0)));
        const double off = n[6] + n[7] * column + n[8] * row + n[2] * inside - pixels[column];
        if (with_slopes) {
          const double by = -n[2] * inside * (1.0 - inside) * steep * 0.5 / rho;
          slope << -2.0 * by * ax, -2.0 * by * ay, inside, by * dx * dx, 2.0 * by * dx * dy,
              by * dy * dy, 1.0, column, row;
        }
        take(off, &slope);
      }
    }
    return true;
  }

  const ImageView& image_;
  int x_;
  int y_;
  int reach_;
  double off2_;
};

Eigen::Matrix2d shape_of(const Disc& disc) {
  Eigen::Matrix2d axes;
  axes << std::cos(disc.angle_rad), -std::sin(disc.angle_rad), std::sin(disc.angle_rad),
      std::cos(disc.angle_rad);
  const Eigen::Vector2d inverse(1.0 / (disc.semi_major_px * disc.semi_major_px),
                                1.0 / (disc.semi_minor_px * disc.semi_minor_px));
  return axes * inverse.asDiagonal() * axes.transpose();
}

Disc disc_of(const Numbers& n, int x, int y) {
  Eigen::Matrix2d shape;
  shape << n[3], n[4], n[4], n[5];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(shape);
  Disc disc;
  disc.centre = {x + n[0], y + n[1]};
  disc.semi_major_px = 1.0 / std::sqrt(solver.eigenvalues()[0]);
  disc.semi_minor_px = 1.0 / std::sqrt(solver.eigenvalues()[1]);
  const Eigen::Vector2d major = solver.eigenvectors().col(0);
  disc.angle_rad = std::atan(major.y() / (major.x() == 0.0 ? 1e-12 : major.x()));
  disc.contrast_dn = n[2];
  return disc;
}

// Levenberg and Marquardt's steps, down to where they gain nothing.
void descend(const Patch& patch, Numbers& n, double& cost) {
  Normal normal;
  Numbers gradient;
  double damping = 1e-3;
  for (int i = 0; i < kMaxSteps; ++i) {
    patch.linearise(n, normal, gradient);
    double gain = 0.0;
    for (int tries = 0; tries < 6 && gain <= 0.0; ++tries) {
      Normal damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Numbers next = n - damped.ldlt().solve(gradient);
      const double there =
          next.allFinite() ? patch.cost(next) : std::numeric_limits<double>::infinity();
      damping *= there < cost ? 0.2 : 5.0;
      if (!(there < cost)) continue;
      gain = cost - there;
      n = next;
      cost = there;
    }
    if (!(gain > 1e-6 * cost)) return;
  }
}

bool is_near(const Disc& disc, const Disc& start) {
  const auto like = [](double a, double b) { return a < kMostStretch * b && b < kMostStretch * a; };
  return (disc.centre - start.centre).norm() < kMostOff * start.semi_minor_px + 0.5 &&
         like(disc.semi_major_px, start.semi_major_px) &&
         like(disc.semi_minor_px, start.semi_minor_px) &&
         disc.contrast_dn / start.contrast_dn > kLeastContrast;
}

}  // namespace

std::optional<Disc> fit_disc(const ImageView& image, const Disc& start) {
  const int x = static_cast<int>(std::lround(start.centre.x()));
  const int y = static_cast<int>(std::lround(start.centre.y()));
  const int reach = static_cast<int>(std::ceil(start.semi_major_px)) + kAround_px;
  const bool inside =
      x >= reach && y >= reach && x + reach < image.width_px && y + reach < image.height_px;
  if (!inside || reach > kMaxReach_px || !(start.semi_minor_px > 0.5)) return std::nullopt;
  const double off_even = std::max(kOffEven_dn, kOffEvenPart * std::abs(start.contrast_dn));
  const Patch patch(image, x, y, reach, off_even);
  const Eigen::Matrix2d shape = shape_of(start);
  const double surround = image.at(x, y) - start.contrast_dn;
  Numbers n;
  n << start.centre.x() - x, start.centre.y() - y, start.contrast_dn, shape(0, 0), shape(0, 1),
      shape(1, 1), surround, 0.0, 0.0;
  double cost = patch.cost(n);
  descend(patch, n, cost);
  if (!std::isfinite(cost)) return std::nullopt;
  Disc disc = disc_of(n, x, y);
  if (!is_near(disc, start)) return std::nullopt;
  Normal normal;
  Numbers gradient;
  patch.linearise(n, normal, gradient);
  const Normal inverse = normal.ldlt().solve(Normal::Identity());
  disc.sigma_px = std::sqrt(0.5 * (inverse(0, 0) + inverse(1, 1)) * cost / patch.pixels());
  return std::isfinite(disc.sigma_px) ? std::optional(disc) : std::nullopt;
}

}  // namespace dottrack::calibrate
