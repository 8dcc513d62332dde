#pragma once
// What is known of any camera beforehand, so loosely that data which determine a number win, and
// numbers that they hardly determine stay where cameras are.

#include "app/workstation/calibrate/fit/adjustment.h"

namespace dottrack::calibrate {

// flat: all its dots are in one plane, so that square pixels and a centre near the image's middle
// have to be taken for granted.
NumberPriors priors_of(const LensKind& kind, const CameraFrame& frame, ImageExtent extent,
                       bool flat);

}  // namespace dottrack::calibrate
