#pragma once
// The projection of app/core/geometry from a camera's numbers, for any scalar that the derivatives
// are taken with.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "app/workstation/calibrate/fit/camera_numbers.h"

namespace dottrack::calibrate {

template <class T>
using Three = Eigen::Matrix<T, 3, 1>;

// The unit quaternion of a small turn t: (1, t / 2) to unit length.
template <class T>
Three<T> turned(const T* t, const Three<T>& v) {
  using std::sqrt;
  const Three<T> half(0.5 * t[0], 0.5 * t[1], 0.5 * t[2]);
  const T norm2 = T(1.0) + half.squaredNorm();
  const Three<T> across = half.cross(v);
  const Three<T> twice = half.cross(across);
  return v + (across + twice) * (T(2.0) / norm2);
}

template <class T>
Three<T> optical_axis(const T* n) {
  using std::sqrt;
  const T length = sqrt(T(1.0) + n[kAxis] * n[kAxis] + n[kAxis + 1] * n[kAxis + 1]);
  return {n[kAxis] / length, n[kAxis + 1] / length, T(1.0) / length};
}

// CAHVOR in the camera's own axes: false where the point is behind.
template <class T>
bool bend_radially(const T* n, const Three<T>& d, Three<T>& bent) {
  const Three<T> o = optical_axis(n);
  const T w = d.dot(o);
  if (!(w > T(0.0))) return false;
  const Three<T> l = d - w * o;
  const T tau = l.squaredNorm() / (w * w);
  bent = d + (tau * (n[kRadial] + tau * n[kRadial + 1])) * l;
  return true;
}

// The angle at which a point's light enters a pupil that moves, by Newton's method: its last steps
// make the derivatives as good as the value.
template <class T>
bool entry_angle(const T& zeta, const T& length, const T& e0, const T& e1, T& theta) {
  using std::abs;
  using std::atan2;
  using std::cos;
  using std::sin;
  constexpr int kSteps = 12;
  theta = atan2(length, zeta);
  for (int i = 0; i < kSteps; ++i) {
    const T sine = sin(theta);
    const T cosine = cos(theta);
    const T e = e0 + theta * theta * e1;
    const T excess = zeta * sine - length * cosine - (theta - sine) * e;
    const T slope =
        zeta * cosine + length * sine - (T(1.0) - cosine) * e - (theta - sine) * (2.0 * theta * e1);
    if (!(slope > T(0.0))) return false;
    const T step = excess / slope;
    theta -= step;
    if (i >= 2 && abs(step) < T(1e-14)) return true;
  }
  return true;
}

// CAHVORE in the camera's own axes.
template <class T>
bool bend_with_pupil(const CameraFrame& frame, double linearity, const T* n, const Three<T>& d,
                     Three<T>& bent) {
  using std::sin;
  using std::sqrt;
  using std::tan;
  const Three<T> o = optical_axis(n);
  const T zeta = d.dot(o);
  const Three<T> lambda = d - zeta * o;
  const T length2 = lambda.squaredNorm();
  if (!(length2 > 1e-24 * zeta * zeta)) {
    bent = d;  // on the axis: nothing is bent
    return zeta > T(0.0);
  }
  const T length = sqrt(length2);
  T theta;
  if (!entry_angle(zeta, length, frame.distance_m * n[kPupil], frame.distance_m * n[kPupil + 1],
                   theta)) {
    return false;
  }
  T chi = theta;
  if (linearity > 0.0) {
    if (!(theta * linearity < T(1.5))) return false;
    chi = tan(linearity * theta) / linearity;
  } else if (linearity < 0.0) {
    if (!(theta * -linearity < T(1.5))) return false;
    chi = sin(linearity * theta) / linearity;
  }
  const T chi2 = chi * chi;
  const T rho = chi * (T(1.0) + chi2 * (n[kRadial] + chi2 * n[kRadial + 1]));
  bent = o + (rho / length) * lambda;
  return true;
}

// The pixel of a point in metres, world; false where the camera cannot see it.
template <class T>
bool project_numbered(const CameraFrame& frame, const LensKind& kind, const T* n,
                      const Three<T>& point_m, T* pixel) {
  using std::exp;
  Three<T> d;
  for (int i = 0; i < 3; ++i) {
    d[i] = point_m[i] - frame.centre_m[i] - frame.distance_m * n[kPlace + i];
  }
  const Three<T> in_frame = frame.rotation.template cast<T>() * d;
  const Three<T> own = turned(n + kTurn, in_frame);
  Three<T> bent = own;
  if (kind.form == LensForm::radial && !bend_radially(n, own, bent)) return false;
  if (kind.form == LensForm::pupil && !bend_with_pupil(frame, kind.linearity, n, own, bent)) {
    return false;
  }
  if (!(bent.z() > T(0.0))) return false;
  const T hs = frame.focal_px * exp(n[kScale]);
  const T vs = hs * exp(n[kAspect]);
  pixel[0] = hs * (bent.x() + n[kSkew] * bent.y()) / bent.z() + frame.middle_px.x() +
             frame.focal_px * n[kCentre];
  pixel[1] = vs * bent.y() / bent.z() + frame.middle_px.y() + frame.focal_px * n[kCentre + 1];
  return true;
}

// C, A, H, V, O, R, E of a camera, one after the other.
template <class T>
std::array<T, 21> vectors_of(const CameraFrame& frame, const T* n) {
  using std::exp;
  const T minus[3] = {-n[0], -n[1], -n[2]};
  const Eigen::Matrix<T, 3, 3> back = frame.rotation.transpose().template cast<T>();
  const auto world = [&](const Three<T>& own) { return Three<T>(back * turned(minus, own)); };
  const T hs = frame.focal_px * exp(n[kScale]);
  const T vs = hs * exp(n[kAspect]);
  const T hc = frame.middle_px.x() + frame.focal_px * n[kCentre];
  const T vc = frame.middle_px.y() + frame.focal_px * n[kCentre + 1];
  const T zero(0.0);
  const Three<T> a = world({zero, zero, T(1.0)});
  const Three<T> h = world({hs, hs * n[kSkew], hc});
  const Three<T> v = world({zero, vs, vc});
  const Three<T> o = world(optical_axis(n));
  std::array<T, 21> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out[i] = frame.centre_m[k] + frame.distance_m * n[kPlace + k];
    out[3 + i] = a[k];
    out[6 + i] = h[k];
    out[9 + i] = v[k];
    out[12 + i] = o[k];
    out[15 + i] = i == 0 ? zero : n[kRadial + k - 1];
    out[18 + i] = i == 2 ? zero : frame.distance_m * n[kPupil + k];
  }
  return out;
}

}  // namespace dottrack::calibrate
