#pragma once
// What the operating system has against a request, as the last part of an error's line.

#include <string>
#include <system_error>

namespace dottrack::rtos {

inline std::string reason_of(int error_number) {
  return std::generic_category().message(error_number);
}

}  // namespace dottrack::rtos
