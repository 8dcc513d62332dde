#include "app/core/protocol/degraded.h"

namespace dottrack::protocol {

std::string_view to_string(Degraded reason) {
  switch (reason) {
    case Degraded::camera_missing:
      return "camera_missing";
    case Degraded::camera_stale:
      return "camera_stale";
    case Degraded::camera_overflow:
      return "camera_overflow";
    case Degraded::iris_fault:
      return "iris_fault";
    case Degraded::dots_missing:
      return "dots_missing";
    case Degraded::single_view_dots:
      return "single_view_dots";
    case Degraded::tick_missed:
      return "tick_missed";
    case Degraded::bus_trouble:
      return "bus_trouble";
    case Degraded::message_lost:
      return "message_lost";
    case Degraded::record_lost:
      return "record_lost";
    case Degraded::not_real_time:
      return "not_real_time";
    case Degraded::covariance_unknown:
      return "covariance_unknown";
    case Degraded::few_cameras:
      return "few_cameras";
    case Degraded::camera_moved:
      return "camera_moved";
    case Degraded::rig_disagrees:
      return "rig_disagrees";
  }
  return "unknown";
}

}  // namespace dottrack::protocol
