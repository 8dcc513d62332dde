#pragma once
// Reasons in sentences: why a tick has no pose, and what a person can do about it.

#include <string_view>

#include "app/core/reason.h"

namespace dottrack::workstation {

struct ReasonWords {
  std::string_view why;
  std::string_view remedy;
};

// Whole sentences. Both are empty for Reason::none.
ReasonWords words_for(core::Reason reason);

}  // namespace dottrack::workstation
