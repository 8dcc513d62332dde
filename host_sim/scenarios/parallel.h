#pragma once
// Independent pieces of work on several threads.

#include <cstddef>
#include <functional>

namespace dottrack::host_sim {

// Calls work(0) ... work(count - 1), each once, in any order. threads 0: as many as the machine
// has. The first exception that a piece throws is thrown again here, after all have ended.
void for_each_index(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t)>& work);

}  // namespace dottrack::host_sim
