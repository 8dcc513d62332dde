#pragma once
// The layout of the unit's messages for the identifiers that a unit was given.

#include <string>
#include <string_view>

#include "app/core/protocol/addressing.h"

namespace dottrack::dbc {

// `layout` (which has the default base and 11 bits) with every identifier moved to the base; with
// 29 bits, identifiers and frame formats say so.
std::string rebased(std::string_view layout, const protocol::Addressing& addressing);

}  // namespace dottrack::dbc
