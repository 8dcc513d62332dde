#pragma once
// The bit rate of a CAN interface, which the kernel tells over rtnetlink only.

#include <cstddef>
#include <cstdint>
#include <span>

namespace dottrack::drivers {

// Bits per second of the arbitration phase; 0 where it is not set, not told or cannot be asked for.
std::uint32_t can_bit_rate(int interface_index);

// The same out of the kernel's answer (RTM_NEWLINK) to the question about one link.
std::uint32_t bit_rate_in(std::span<const std::byte> answer);

}  // namespace dottrack::drivers
