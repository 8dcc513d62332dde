#include "app/workstation/calibrate/fit/single_camera.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace dottrack::calibrate {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::span<const Vector3d>;
using Pixels = std::span<const Vector2d>;

constexpr double kFlat = 2e-3;       // thickness over width of points that are in one plane
constexpr double kOnALine = 1e-3;    // width over length of points that are on one line
constexpr double kLeastTilt = 1e-3;  // of a plane's perspective, over that of a plane edge on
constexpr double kNoise_px = 0.5;    // what the priors are weighed against
constexpr double kAspectSigma = 0.05;
constexpr double kCentreSigma = 0.5;       // of the image's longer side
constexpr double kFlatCentreSigma = 0.01;  // where all points are in one plane
constexpr double kFlatAspectSigma = 0.002;
constexpr int kMostSteps = 30;

// The cloud's own axes, the longest first.
struct Cloud {
  Vector3d middle;
  Matrix3d axes;      // columns
  Vector3d spread_m;  // along each
  bool flat() const { return spread_m.z() < kFlat * spread_m.y(); }
};

Cloud cloud_of(Points points) {
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  Matrix3d scatter = Matrix3d::Zero();
  for (const Vector3d& p : points) scatter += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(scatter /
                                                       static_cast<double>(points.size()));
  Cloud cloud{middle, solver.eigenvectors().rowwise().reverse(),
              solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt()};
  if (cloud.axes.determinant() < 0.0) cloud.axes.col(2) *= -1.0;
  return cloud;
}

// x' = (x - middle) / size has a mean square of 2.
struct PixelFrame {
  Vector2d middle = Vector2d::Zero();
  double size = 1.0;
};

PixelFrame frame_of(Pixels pixels) {
  PixelFrame frame;
  for (const Vector2d& p : pixels) frame.middle += p;
  frame.middle /= static_cast<double>(pixels.size());
  double square = 0.0;
  for (const Vector2d& p : pixels) square += (p - frame.middle).squaredNorm();
  frame.size = std::sqrt(square / (2.0 * static_cast<double>(pixels.size())));
  return frame;
}

// The right singular vector of the smallest singular value; nothing where a second is as small.
std::optional<Eigen::VectorXd> null_vector(const MatrixXd& equations) {
  const Eigen::HouseholderQR<MatrixXd> qr(equations);
  const Eigen::Index n = equations.cols();
  const MatrixXd upper = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<MatrixXd> svd(upper, Eigen::ComputeFullV);
  if (!(svd.singularValues()[n - 2] > 1e-9 * svd.singularValues()[0])) return std::nullopt;
  return svd.matrixV().col(n - 1);
}

// A pinhole camera as ten numbers.
struct Pinhole {
  Matrix3d rotation;  // rows: to the right, down, forward, in the world
  Vector3d centre_m;
  Vector2d scale_px;
  Vector2d middle_px;

  geometry::Cahv model() const {
    const Vector3d a = rotation.row(2).transpose();
    return {centre_m, a, scale_px.x() * rotation.row(0).transpose() + middle_px.x() * a,
            scale_px.y() * rotation.row(1).transpose() + middle_px.y() * a};
  }
};

// Nearest pinhole camera to a linear one; its second axis is up where the points are mirrored.
Pinhole without_skew(const geometry::Cahv& m) {
  const Vector3d across = m.h - m.a.dot(m.h) * m.a;
  const Vector3d down = m.v - m.a.dot(m.v) * m.a;
  Pinhole camera;
  camera.scale_px = {across.norm(), down.norm()};
  camera.middle_px = {m.a.dot(m.h), m.a.dot(m.v)};
  const double sign = across.cross(down).dot(m.a) < 0.0 ? -1.0 : 1.0;
  // Both axes give way alike.
  const Vector3d half = (across.normalized() + sign * down.normalized().cross(m.a)).normalized();
  camera.rotation.row(0) = half.transpose();
  camera.rotation.row(1) = m.a.cross(half).transpose();
  camera.rotation.row(2) = m.a.transpose();
  if (sign < 0.0) camera.scale_px.y() *= -1.0;
  camera.centre_m = m.c;
  return camera;
}

std::optional<Pinhole> linear_start(Points points, Pixels pixels, const Cloud& cloud) {
  if (points.size() < 6) return std::nullopt;
  const double size_m = cloud.spread_m.norm() / std::sqrt(3.0);
  const PixelFrame frame = frame_of(pixels);
  const auto rows = static_cast<Eigen::Index>(std::max<std::size_t>(2 * points.size(), 12));
  MatrixXd equations = MatrixXd::Zero(rows, 12);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    Eigen::RowVector4d p;
    p << (points[i] - cloud.middle).transpose() / size_m, 1.0;
    const Vector2d at = (pixels[i] - frame.middle) / frame.size;
    equations.block<1, 4>(row, 0) = p;
    equations.block<1, 4>(row, 8) = -at.x() * p;
    equations.block<1, 4>(row + 1, 4) = p;
    equations.block<1, 4>(row + 1, 8) = -at.y() * p;
  }
  const auto solution = null_vector(equations);
  if (!solution) return std::nullopt;
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> p(solution->data());
  const Matrix3d linear = p.leftCols<3>();
  const double norm = linear.row(2).norm();
  const Eigen::FullPivLU<Matrix3d> lu(linear);
  if (!(norm > 0.0) || !lu.isInvertible()) return std::nullopt;
  const Vector3d centre = -lu.solve(p.col(3));
  const double sign = linear.row(2).dot(-centre.transpose()) < 0.0 ? -1.0 : 1.0;
  geometry::Cahv m;
  m.c = cloud.middle + size_m * centre;
  m.a = sign * linear.row(2).transpose() / norm;
  m.h = frame.size * sign * linear.row(0).transpose() / norm + frame.middle.x() * m.a;
  m.v = frame.size * sign * linear.row(1).transpose() / norm + frame.middle.y() * m.a;
  return without_skew(m);
}

// Points of a plane in their own two coordinates to pixels about the image's middle.
std::optional<Matrix3d> homography(Points points, Pixels pixels, const Cloud& cloud,
                                   const Vector2d& middle_px, double size_px) {
  const double size_m = cloud.spread_m.head<2>().norm() / std::sqrt(2.0);
  const auto rows = static_cast<Eigen::Index>(std::max<std::size_t>(2 * points.size(), 9));
  MatrixXd equations = MatrixXd::Zero(rows, 9);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    const Vector3d own = cloud.axes.transpose() * (points[i] - cloud.middle) / size_m;
    const Eigen::RowVector3d p(own.x(), own.y(), 1.0);
    const Vector2d at = (pixels[i] - middle_px) / size_px;
    equations.block<1, 3>(row, 0) = p;
    equations.block<1, 3>(row, 6) = -at.x() * p;
    equations.block<1, 3>(row + 1, 3) = p;
    equations.block<1, 3>(row + 1, 6) = -at.y() * p;
  }
  const auto solution = null_vector(equations);
  if (!solution) return std::nullopt;
  Matrix3d h = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(solution->data());
  h.leftCols<2>() /= size_m;
  return h(2, 2) < 0.0 ? Matrix3d(-h) : h;
}

// 1 / f^2, f in units of the pixels' size, from the plane's two axes being square to each other and
// of equal length. Not positive where the plane shows no perspective.
double inverse_square_focal(const Matrix3d& h) {
  const Vector3d u = h.col(0);
  const Vector3d v = h.col(1);
  const Vector2d image(u.head<2>().dot(v.head<2>()),
                       u.head<2>().squaredNorm() - v.head<2>().squaredNorm());
  const Vector2d depth(u.z() * v.z(), u.z() * u.z() - v.z() * v.z());
  const double scale = u.head<2>().squaredNorm() + v.head<2>().squaredNorm();
  if (!(image.norm() > kLeastTilt * scale)) return 0.0;
  return -image.dot(depth) / image.squaredNorm();
}

std::optional<Pinhole> planar_start(const Matrix3d& h, double focal, const Cloud& cloud,
                                    const Vector2d& middle_px, double size_px) {
  Matrix3d posed = h;
  posed.topRows<2>() /= focal;
  const double scale = std::sqrt(posed.col(0).norm() * posed.col(1).norm());
  if (!(scale > 0.0)) return std::nullopt;
  posed /= scale;
  Matrix3d turn;
  turn << posed.col(0), posed.col(1), posed.col(0).cross(posed.col(1));
  const Eigen::JacobiSVD<Matrix3d> svd(turn, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  if (!(rotation.determinant() > 0.0)) return std::nullopt;
  Pinhole camera;
  camera.rotation = rotation * cloud.axes.transpose();
  camera.centre_m = cloud.middle - camera.rotation.transpose() * posed.col(2);
  camera.scale_px = Vector2d::Constant(focal * size_px);
  camera.middle_px = middle_px;
  return camera;
}

using Ten = Eigen::Matrix<double, 10, 1>;
using TenByTen = Eigen::Matrix<double, 10, 10>;

struct Prior {
  Vector2d middle_px = Vector2d::Zero();
  double centre_sigma_px = 0.0;  // 0: none
  double aspect_sigma = 0.0;     // of log(vs / hs); 0: none
};

Pinhole moved(const Pinhole& camera, const Ten& by) {
  Pinhole next = camera;
  const Vector3d turn = by.head<3>();
  const double angle = turn.norm();
  if (angle > 0.0) {
    next.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * camera.rotation;
  }
  next.centre_m += by.segment<3>(3);
  next.scale_px = next.scale_px.cwiseProduct(by.segment<2>(6).array().exp().matrix());
  next.middle_px += by.tail<2>();
  return next;
}

double log_aspect(const Pinhole& camera) {
  return std::log(std::abs(camera.scale_px.y() / camera.scale_px.x()));
}

// Half the sum of squares in units of kNoise_px; infinite if a point is behind the camera.
double cost_of(const Pinhole& camera, Points points, Pixels pixels, const Prior& prior) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d q = camera.rotation * (points[i] - camera.centre_m);
    if (!(q.z() > 0.0)) return std::numeric_limits<double>::infinity();
    const Vector2d at = camera.scale_px.cwiseProduct(q.head<2>() / q.z()) + camera.middle_px;
    sum += (at - pixels[i]).squaredNorm() / (kNoise_px * kNoise_px);
  }
  if (prior.centre_sigma_px > 0.0) {
    sum += ((camera.middle_px - prior.middle_px) / prior.centre_sigma_px).squaredNorm();
  }
  if (prior.aspect_sigma > 0.0) {
    const double off = log_aspect(camera) / prior.aspect_sigma;
    sum += off * off;
  }
  return 0.5 * sum;
}

void linearise(const Pinhole& camera, Points points, Pixels pixels, const Prior& prior,
               TenByTen& normal, Ten& gradient) {
  normal.setZero();
  gradient.setZero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d q = camera.rotation * (points[i] - camera.centre_m);
    const Vector2d t = q.head<2>() / q.z();
    Eigen::Matrix<double, 2, 3> dq;                                // of the pixel by q
    dq << camera.scale_px.x(), 0.0, -camera.scale_px.x() * t.x(),  //
        0.0, camera.scale_px.y(), -camera.scale_px.y() * t.y();
    dq /= q.z();
    Matrix3d cross;  // d(q) / d(turn)
    cross << 0.0, q.z(), -q.y(), -q.z(), 0.0, q.x(), q.y(), -q.x(), 0.0;
    Eigen::Matrix<double, 2, 10> j = Eigen::Matrix<double, 2, 10>::Zero();
    j.leftCols<3>() = dq * cross;
    j.middleCols<3>(3) = -dq * camera.rotation;
    j(0, 6) = camera.scale_px.x() * t.x();
    j(1, 7) = camera.scale_px.y() * t.y();
    j.rightCols<2>().setIdentity();
    j /= kNoise_px;
    const Vector2d off =
        (camera.scale_px.cwiseProduct(t) + camera.middle_px - pixels[i]) / kNoise_px;
    normal += j.transpose() * j;
    gradient += j.transpose() * off;
  }
  if (prior.centre_sigma_px > 0.0) {
    const double weight = 1.0 / (prior.centre_sigma_px * prior.centre_sigma_px);
    normal.bottomRightCorner<2, 2>().diagonal().array() += weight;
    gradient.tail<2>() += weight * (camera.middle_px - prior.middle_px);
  }
  if (prior.aspect_sigma > 0.0) {
    Ten j = Ten::Zero();
    j[6] = -1.0 / prior.aspect_sigma;
    j[7] = 1.0 / prior.aspect_sigma;
    normal += j * j.transpose();
    gradient += j * (log_aspect(camera) / prior.aspect_sigma);
  }
}

// Levenberg and Marquardt, on equations scaled to a unit diagonal.
double refine(Pinhole& camera, Points points, Pixels pixels, const Prior& prior) {
  double cost = cost_of(camera, points, pixels, prior);
  double damping = 1e-4;
  for (int i = 0; i < kMostSteps && std::isfinite(cost) && damping < 1e8; ++i) {
    TenByTen normal;
    Ten gradient;
    linearise(camera, points, pixels, prior, normal, gradient);
    const Ten scale = normal.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
    const TenByTen scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    for (; damping < 1e8; damping *= 10.0) {
      const TenByTen damped = scaled + damping * TenByTen::Identity();
      const Ten by = -scale.cwiseProduct(damped.ldlt().solve(scale.cwiseProduct(gradient)));
      const Pinhole next = moved(camera, by);
      const double reached = cost_of(next, points, pixels, prior);
      if (!(reached <= cost)) continue;
      const bool arrived = cost - reached <= 1e-10 * cost;
      camera = next;
      cost = reached;
      damping *= 0.1;
      if (arrived) return cost;
      break;
    }
  }
  return cost;
}

Prior prior_of(ImageExtent extent, bool flat) {
  if (extent.width_px <= 0 || extent.height_px <= 0) return {};
  const double longer = std::max(extent.width_px, extent.height_px);
  return {0.5 * Vector2d(extent.width_px - 1, extent.height_px - 1),
          longer * (flat ? kFlatCentreSigma : kCentreSigma),
          flat ? kFlatAspectSigma : kAspectSigma};
}

// Starts from the points' best plane: with the focal length that its perspective shows, and, where
// they have some thickness to tell it by, with a few others.
std::vector<Pinhole> plane_starts(Points points, Pixels pixels, const Cloud& cloud,
                                  ImageExtent extent) {
  std::vector<Pinhole> starts;
  if (extent.width_px <= 0) return starts;
  const Vector2d middle = prior_of(extent, true).middle_px;
  const double size_px = std::max(extent.width_px, extent.height_px);
  const auto h = homography(points, pixels, cloud, middle, size_px);
  if (!h) return starts;
  std::vector<double> focals;
  if (const double u = inverse_square_focal(*h); u > 1e-4) focals.push_back(1.0 / std::sqrt(u));
  if (!cloud.flat()) focals.insert(focals.end(), {0.6, 1.5, 4.0, 10.0});
  for (const double focal : focals) {
    if (const auto start = planar_start(*h, focal, cloud, middle, size_px)) {
      starts.push_back(*start);
    }
  }
  return starts;
}

}  // namespace

std::optional<geometry::Cahv> fit_cahv(Points points, Pixels pixels, ImageExtent extent) {
  if (points.size() != pixels.size() || points.size() < 4) return std::nullopt;
  const Cloud cloud = cloud_of(points);
  if (!(cloud.spread_m.y() > kOnALine * cloud.spread_m.x())) return std::nullopt;
  if (!cloud.flat() && points.size() < 6) return std::nullopt;
  std::vector<Pinhole> starts;
  if (!cloud.flat()) {
    if (const auto start = linear_start(points, pixels, cloud)) starts.push_back(*start);
  }
  // The linear way loses its footing where the points are nearly in a plane.
  const bool thin = cloud.spread_m.z() < 0.1 * cloud.spread_m.y();
  if (thin || starts.empty()) {
    const auto more = plane_starts(points, pixels, cloud, extent);
    starts.insert(starts.end(), more.begin(), more.end());
  }
  const Prior prior = prior_of(extent, cloud.flat());
  double least = std::numeric_limits<double>::infinity();
  std::optional<Pinhole> best;
  for (Pinhole& camera : starts) {
    const double cost = refine(camera, points, pixels, prior);
    if (!(cost < least)) continue;
    least = cost;
    best = camera;
  }
  if (!best) return std::nullopt;
  const geometry::Cahv model = best->model();
  const bool finite = (model.c + model.a + model.h + model.v).allFinite();
  return finite ? std::optional(model) : std::nullopt;
}

bool mirrored(const geometry::Cahv& model) {
  return model.h.cross(model.v).dot(model.a) < 0.0;
}

double rms_px(const geometry::Cahv& model, Points points, Pixels pixels) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector2d at;
    if (project(model, points[i], at) != geometry::OpticsStatus::ok) {
      return std::numeric_limits<double>::infinity();
    }
    sum += (at - pixels[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(points.size(), 1)));
}

}  // namespace dottrack::calibrate
