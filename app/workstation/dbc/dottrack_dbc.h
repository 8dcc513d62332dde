#pragma once
// The layout of the unit's messages as a text, part of the program.

#include <string_view>

namespace dottrack::dbc {

// app/core/protocol/dottrack.dbc, byte by byte.
std::string_view dottrack_dbc();

}  // namespace dottrack::dbc
