#pragma once
// What light control is told of a rig.

#include "app/config/rig_file.h"
#include "app/core/exposure/light_settings.h"

namespace dottrack::config {

// Start-up only.
exposure::LightSettings light_settings(const RigConfig& config);

}  // namespace dottrack::config
