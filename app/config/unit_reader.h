#pragma once
// The parts of a rig file that say what the unit is wired to.

#include <toml++/toml.h>

#include "app/config/table_reader.h"
#include "app/config/unit_config.h"

namespace dottrack::config {

// device, exposure_ms, gain, stamp_offset_ms and iris, of a [[camera]].
CameraUnitConfig read_camera_unit(Complaint& complaint, TableReader& camera);

// [can], [trigger], [lamp], [loop] and [recording]; all may be missing.
void read_unit(Complaint& complaint, const toml::table& root, UnitConfig& unit);

}  // namespace dottrack::config
