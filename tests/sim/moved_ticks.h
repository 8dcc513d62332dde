#pragma once
// When cameras are said to have been moved.

#include <cstddef>
#include <filesystem>
#include <vector>

namespace dottrack::test {

// The first tick of each of `cameras` cameras that poses.csv in `out` calls moved; -1: never.
std::vector<int> moved_ticks(const std::filesystem::path& out, std::size_t cameras);

}  // namespace dottrack::test
