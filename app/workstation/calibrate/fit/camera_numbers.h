#pragma once
// A camera as the fewest numbers that say it, each of the order of 1 a camera's own size, so that
// least squares over them are well conditioned; and JPL's vectors from them.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/core/geometry/camera_model.h"
#include "app/workstation/calibrate/fit/single_camera.h"

namespace dottrack::calibrate {

// Where each number is. A number that a kind of model does not have stays zero.
inline constexpr int kTurn = 0;     // 3: small rotation about the camera's own axes, radians
inline constexpr int kPlace = 3;    // 3: of C, world axes, in distances
inline constexpr int kScale = 6;    // log of hs over the frame's focal length
inline constexpr int kAspect = 7;   // log of vs / hs
inline constexpr int kCentre = 8;   // 2: of (hc, vc) from the frame's middle, in focal lengths
inline constexpr int kSkew = 10;    // of the columns, radians
inline constexpr int kAxis = 11;    // 2: tangents from A to O, to the right and down
inline constexpr int kRadial = 13;  // 2: r1, r2
inline constexpr int kRadialTerms = 2;
inline constexpr int kPupil = 15;  // 2: e0, e1, in distances
inline constexpr int kNumbers = 17;

using Numbers = std::array<double, kNumbers>;

// What numbers are relative to.
struct CameraFrame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // rows: right, down, forward, world
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();      // world
  double distance_m = 1.0;                                 // to the dots, roughly
  double focal_px = 1.0;
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
};

enum class LensForm : std::uint8_t { pinhole, radial, pupil };  // CAHV, CAHVOR, CAHVORE

// Which numbers a model has.
struct LensKind {
  LensForm form = LensForm::pinhole;
  bool own_axis = false;    // O is free: else it is A
  bool two_radial = false;  // r2 too
  double linearity = 1.0;   // of CAHVORE
};

bool is_free(const LensKind& kind, int number);
int count_free(const LensKind& kind);

struct NumberedCamera {
  CameraFrame frame;
  LensKind kind;
  Numbers numbers{};
};

geometry::CameraModel model_of(const NumberedCamera& camera);

// The numbers of a right-handed model; what it has beyond the kind is left away.
NumberedCamera numbered(const geometry::CameraModel& model, ImageExtent extent, double distance_m,
                        const LensKind& kind);

// The same camera with no turn and no place left in its numbers.
void rebase(NumberedCamera& camera);

// d(C, A, H, V [, O, R [, E]]) / d(numbers), of a rebased camera: 12, 18 or 21 rows.
Eigen::MatrixXd vectors_jacobian(const NumberedCamera& camera);

// A pixel and its derivatives.
struct ViewLinear {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, kNumbers> by_numbers;
  Eigen::Matrix<double, 2, 3> by_point;  // pixels a metre
};
std::optional<ViewLinear> linear_view(const NumberedCamera& camera, const Eigen::Vector3d& point_m);

}  // namespace dottrack::calibrate
