#pragma once
// What a pixel shows, surface by surface.

#include <Eigen/Core>
#include <limits>

#include "hal/base/static_vector.h"
#include "host_sim/renderer/actor.h"

namespace dottrack::host_sim {

// What one line of sight meets first.
struct Look {
  int thing = kNothing;
  double distance = std::numeric_limits<double>::infinity();  // in units of the line's direction
  Eigen::Vector3d point = Eigen::Vector3d::Zero();            // world
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();           // unit, towards the eye; world
};

// Looks that may be shaded as one: the same solid, and no edge between them (25 degrees).
inline bool same_face(const Look& a, const Look& b) {
  return a.thing == b.thing && (a.thing == kNothing || a.normal.dot(b.normal) > 0.906);
}

// The part of a pixel that one face covers, and where it is seen on the average.
struct Patch {
  Look look;
  int mark = -1;       // of the actor's model; -1: bare
  double share = 0.0;  // of the pixel's area
};

using Patches = StaticVector<Patch, 16>;

}  // namespace dottrack::host_sim
