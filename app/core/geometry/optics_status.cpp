#include "app/core/geometry/optics_status.h"

namespace dottrack::geometry {

std::string_view to_string(OpticsStatus status) {
  switch (status) {
    case OpticsStatus::ok:
      return "ok";
    case OpticsStatus::behind:
      return "behind";
    case OpticsStatus::at_centre:
      return "at_centre";
    case OpticsStatus::outside_domain:
      return "outside_domain";
    case OpticsStatus::not_converged:
      return "not_converged";
    case OpticsStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

}  // namespace dottrack::geometry
