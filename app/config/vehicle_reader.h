#pragma once
// [vehicle]: how the vehicle can move.

#include <toml++/toml.h>

#include "app/config/complaint.h"
#include "app/core/rig.h"

namespace dottrack::config {

// The limits of the table [vehicle]; angles are degrees in the file. What is missing keeps its
// default.
core::MotionLimits read_vehicle(Complaint& complaint, const toml::table& table);

}  // namespace dottrack::config
