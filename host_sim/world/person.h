#pragma once
// Somebody who stands or walks about.

#include <cstdint>

#include "host_sim/world/model.h"

namespace dottrack::host_sim {

// About 1.75 m tall, feet at the origin, facing x. Clothes, and what is carried (a white helmet, a
// cup), by the seed.
Model make_person(std::uint64_t seed);

}  // namespace dottrack::host_sim
