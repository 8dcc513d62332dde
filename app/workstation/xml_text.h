#pragma once
// Text that goes into XML, SVG or HTML.

#include <string>
#include <string_view>

namespace dottrack::workstation {

// `text` with the five characters that mean something to XML written out.
std::string escaped(std::string_view text);

}  // namespace dottrack::workstation
