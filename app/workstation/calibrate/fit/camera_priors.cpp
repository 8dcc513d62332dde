#include "app/workstation/calibrate/fit/camera_priors.h"

#include <algorithm>
#include <cmath>

namespace dottrack::calibrate {
namespace {

constexpr double kAspectSigma = 0.05;
constexpr double kFlatAspectSigma = 0.002;
constexpr double kCentreSigma = 0.5;  // of the image's longer side
constexpr double kFlatCentreSigma = 0.02;
constexpr double kSkewSigma = 2e-3;
constexpr double kAxisSigma = 0.05;
constexpr double kPortAxisSigma = 0.5;  // of CAHVORE: the axis may be that of a window
constexpr double kBendSigma = 0.3;   // of the image's half diagonal, what a radial term does there
constexpr double kPupilSigma = 0.3;  // distances

}  // namespace

NumberPriors priors_of(const LensKind& kind, const CameraFrame& frame, ImageExtent extent,
                       bool flat) {
  const double longer = std::max(extent.width_px, extent.height_px);
  const double half_diagonal = 0.5 * std::hypot(extent.width_px, extent.height_px);
  const double tangent2 = std::min(std::pow(half_diagonal / frame.focal_px, 2), 4.0);
  NumberPriors p;
  p.sigma[kAspect] = flat ? kFlatAspectSigma : kAspectSigma;
  p.sigma[kCentre] = (flat ? kFlatCentreSigma : kCentreSigma) * longer / frame.focal_px;
  p.sigma[kCentre + 1] = p.sigma[kCentre];
  p.sigma[kSkew] = kSkewSigma;
  p.sigma[kAxis] = kind.form == LensForm::pupil ? kPortAxisSigma : kAxisSigma;
  p.sigma[kAxis + 1] = p.sigma[kAxis];
  p.sigma[kRadial] = kBendSigma / tangent2;
  p.sigma[kRadial + 1] = kBendSigma / (tangent2 * tangent2);
  p.sigma[kPupil] = kPupilSigma;
  p.sigma[kPupil + 1] = kPupilSigma;
  p.loosest = p.sigma;
  return p;
}

}  // namespace dottrack::calibrate
