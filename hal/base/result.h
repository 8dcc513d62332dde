#pragma once
// What can go wrong at start-up is a Result: a value, or one line for the person who reads it.
// Nothing in the loop returns one; there, plain enumerations say what happened.

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace dottrack {

struct Error {
  std::string message;  // one line: where, what, what was expected
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace dottrack
