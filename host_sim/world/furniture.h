#pragma once
// What stands about in a workshop. Each thing stands on z = 0 about the origin, its front to -y.

#include <cstdint>

#include "host_sim/world/model.h"

namespace dottrack::host_sim {

Model make_cabinet(std::uint64_t seed);       // 0.95 x 0.5 m, up to 2 m tall
Model make_table(std::uint64_t seed);         // 1.6 x 0.7 m, with things on it
Model make_chair(std::uint64_t seed);         // 0.6 m across
Model make_tool_chest(std::uint64_t seed);    // 0.75 x 0.5 m
Model make_covered_heap(std::uint64_t seed);  // 1 x 0.7 m, under a plastic cover
Model make_raised_floor(std::uint64_t seed);  // tiles on feet, 2.4 x 1.8 m
Model make_hand_tool(std::uint64_t seed);     // 0.3 m, lying
Model make_stand(std::uint64_t seed);         // a pole on three feet with something bright on it
Model make_bin(std::uint64_t seed);           // a bucket, drum or cone

}  // namespace dottrack::host_sim
