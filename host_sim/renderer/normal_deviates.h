#pragma once
// Normal deviates by table, four from one random word: fast enough for every pixel of every frame.

#include <array>
#include <cstddef>

namespace dottrack::host_sim {

// The normal distribution's quantiles at (i + 1/2) / 65536, scaled to variance 1; mean 0, extremes
// 4.3. An index drawn evenly makes a normal deviate.
using NormalDeviates = std::array<float, 65536>;

const NormalDeviates& normal_deviates();

}  // namespace dottrack::host_sim
