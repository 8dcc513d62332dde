#pragma once
// A fuzz target's way to fail: the fuzzer keeps the input on which a program stops.

#include <cstdio>
#include <cstdlib>

namespace dottrack::fuzz {

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace dottrack::fuzz
