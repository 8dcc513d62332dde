#include "app/core/reason.h"

namespace dottrack::core {

std::string_view to_string(State state) {
  return state == State::tracking ? "tracking" : "acquiring";
}

std::string_view to_string(Reason reason) {
  switch (reason) {
    case Reason::none:
      return "none";
    case Reason::no_frames:
      return "no_frames";
    case Reason::too_few_cameras:
      return "too_few_cameras";
    case Reason::too_few_regions:
      return "too_few_regions";
    case Reason::too_few_finalists:
      return "too_few_finalists";
    case Reason::no_matching_subset:
      return "no_matching_subset";
    case Reason::upside_down:
      return "upside_down";
    case Reason::residual:
      return "residual";
    case Reason::not_confirmed:
      return "not_confirmed";
    case Reason::too_few_dots:
      return "too_few_dots";
    case Reason::degenerate_geometry:
      return "degenerate_geometry";
    case Reason::step_too_large:
      return "step_too_large";
    case Reason::work_budget:
      return "work_budget";
    case Reason::ambiguous:
      return "ambiguous";
    case Reason::stopped:
      return "stopped";
    case Reason::held_back:
      return "held_back";
  }
  return "unknown";
}

}  // namespace dottrack::core
