#pragma once
// JPL's family of camera models behind one type (paper section 3.4).

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "app/core/geometry/cahv.h"
#include "app/core/geometry/cahvor.h"
#include "app/core/geometry/cahvore.h"
#include "app/core/geometry/optics_status.h"
#include "app/core/geometry/ray.h"

namespace dottrack::geometry {

using CameraModel = std::variant<Cahv, Cahvor, Cahvore>;

// 3-D to 2-D. p_world in metres; pixel (x, y). With jacobian: d(x, y)/d(X, Y, Z), pixels a metre.
// Outputs are written only when the status is ok.
OpticsStatus project(const CameraModel& model, const Eigen::Vector3d& p_world,
                     Eigen::Vector2d& pixel, ProjectionJacobian* jacobian = nullptr) noexcept;

// 2-D to 3-D. Outputs are written only when the status is ok.
OpticsStatus unproject(const CameraModel& model, const Eigen::Vector2d& pixel, Ray& ray,
                       RayJacobian* jacobian = nullptr) noexcept;

// Many points, or many pixels, of one camera: the model's kind is looked up once. All spans are of
// the same length. Where a status is not ok the output beside it is left as it was.
void project_all(const CameraModel& model, std::span<const Eigen::Vector3d> p_world,
                 std::span<Eigen::Vector2d> pixels, std::span<OpticsStatus> statuses) noexcept;
void project_all(const CameraModel& model, std::span<const Eigen::Vector3d> p_world,
                 std::span<Eigen::Vector2d> pixels, std::span<ProjectionJacobian> jacobians,
                 std::span<OpticsStatus> statuses) noexcept;
void unproject_all(const CameraModel& model, std::span<const Eigen::Vector2d> pixels,
                   std::span<Ray> rays, std::span<OpticsStatus> statuses) noexcept;
void unproject_all(const CameraModel& model, std::span<const Eigen::Vector2d> pixels,
                   std::span<Ray> rays, std::span<RayJacobian> jacobians,
                   std::span<OpticsStatus> statuses) noexcept;

// One word: CAHV, CAHVOR, CAHVORE.
std::string_view class_name(const CameraModel& model) noexcept;

// The point that distances from the camera are measured from: C, metres, world.
const Eigen::Vector3d& centre(const CameraModel& model) noexcept;

// The same camera as a CAHVOR model, which CAHV is without distortion; false for others.
bool as_cahvor(const CameraModel& model, Cahvor& cahvor) noexcept;

}  // namespace dottrack::geometry
