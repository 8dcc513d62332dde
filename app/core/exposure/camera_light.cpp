#include "app/core/exposure/camera_light.h"

namespace dottrack::exposure {

std::string_view to_string(LightState state) {
  switch (state) {
    case LightState::off:
      return "off";
    case LightState::searching:
      return "searching";
    case LightState::settling:
      return "settling";
    case LightState::steady:
      return "steady";
    case LightState::too_dark:
      return "too_dark";
    case LightState::too_bright:
      return "too_bright";
    case LightState::iris_fault:
      return "iris_fault";
  }
  return "unknown";
}

std::string_view to_string(IrisCondition condition) {
  switch (condition) {
    case IrisCondition::automatic:
      return "automatic";
    case IrisCondition::ok:
      return "ok";
    case IrisCondition::at_end:
      return "at_end";
    case IrisCondition::fault:
      return "fault";
  }
  return "unknown";
}

}  // namespace dottrack::exposure
