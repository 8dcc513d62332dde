#pragma once
// One thing that can be seen.

#include <utility>

#include "host_sim/world/material.h"
#include "host_sim/world/shapes.h"

namespace dottrack::host_sim {

struct Object {
  Shape shape;
  Material material;
  Ball bound;
  bool is_mark = false;   // a dot or something like one: its edge is rendered with extra care
  bool obstructs = true;  // can hide what is behind it and throw a shadow; marks and walls do not
};

inline Object make_object(Shape shape, const Material& material) {
  Object object{std::move(shape), material, {}, false, true};
  object.bound = bounding_ball(object.shape);
  return object;
}

// A round mark, painted or glued on: a dot of the target, or a thing that looks like one.
inline Object make_mark(const Disc& disc, double albedo) {
  Object object = make_object(disc, {albedo, Pattern::plain, 0.0, 0});
  object.is_mark = true;
  object.obstructs = false;
  return object;
}

}  // namespace dottrack::host_sim
