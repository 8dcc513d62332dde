#pragma once
// How one camera stands with the light: plain data for the record of a tick.

#include <cstdint>
#include <string_view>

#include "app/core/exposure/light_settings.h"

namespace dottrack::exposure {

// The numbers go out on CAN and never change meaning.
enum class LightState : std::uint8_t {
  off = 0,         // light control is off, or the camera cannot be set
  searching = 1,   // nothing to go by but the whole image
  settling = 2,    // a change is on its way, or due
  steady = 3,      // its dots are as bright as they should be
  too_dark = 4,    // exposure, gain and iris are at their end, and the dots still dark
  too_bright = 5,  // ... and still too bright
  iris_fault = 6,  // the iris does not answer, or its movements do not change the light
};

std::string_view to_string(LightState state);

// The numbers go out on CAN and never change meaning.
enum class IrisCondition : std::uint8_t {
  automatic = 0,  // the lens's own control has it, or there is none that takes orders
  ok = 1,         // set by the unit
  at_end = 2,     // goes no further the way it was last sent
  fault = 3,      // does not answer, or its movements do not change the light
};

std::string_view to_string(IrisCondition condition);

struct CameraLight {
  LightState state = LightState::off;
  ExposureSetting setting;  // as last accepted by the camera
  double opening = 1.0;     // of the iris, as it says of itself
  IrisCondition iris = IrisCondition::automatic;
  // Of the dots seen in this tick; of the image's brightest parts where none is.
  int peak_dn = 0;
  int contrast_dn = 0;   // of the brightest dot to its surround
  int noise_dn = 0;      // standard deviation of its surround
  int saturated_px = 0;  // inside the dots
  int saturated_around_px = 0;
};

}  // namespace dottrack::exposure
