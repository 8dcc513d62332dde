#include "app/core/dot_flaw.h"

namespace dottrack::core {

std::string_view to_string(DotFlaw flaw) {
  switch (flaw) {
    case DotFlaw::none:
      return "none";
    case DotFlaw::border:
      return "border";
    case DotFlaw::saturated:
      return "saturated";
    case DotFlaw::hidden:
      return "hidden";
    case DotFlaw::merged:
      return "merged";
    case DotFlaw::faint:
      return "faint";
    case DotFlaw::not_fitted:
      return "not_fitted";
  }
  return "not_fitted";
}

}  // namespace dottrack::core
