#pragma once
// Independent pieces of work on several threads; each writes to a place of its own, so that the
// result is the same whatever their number.

#include <cstddef>
#include <functional>

namespace dottrack::calibrate {

// Calls work(0) ... work(count - 1), each once, in any order. threads 0: as many as the machine
// has.
void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t)>& work);

}  // namespace dottrack::calibrate
