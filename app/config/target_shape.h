#pragma once
// Which sets of dots cannot serve as a target.

#include <optional>
#include <span>
#include <string>

#include "app/core/rig.h"

namespace dottrack::config {

struct ShapeFault {
  std::size_t dot = 0;  // index of the dot whose line to name
  std::string what;     // dot "3" coincides with dot "2"
  std::string expected;
};

// Dots at one place, dots that overlap, or all dots on a line: such a target has no unique pose, or
// two of its dots cannot be told apart. `ids` are the names for messages, one a dot.
std::optional<ShapeFault> find_shape_fault(std::span<const core::TargetDot> dots,
                                           std::span<const std::string> ids);

}  // namespace dottrack::config
