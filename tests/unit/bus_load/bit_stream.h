#pragma once
// A CAN frame bit by bit, as a controller puts it onto the line (ISO 11898-1:2015): built to count
// what the formulas of the load predict, and so by other means.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dottrack::test {

struct LineFrame {
  std::uint32_t id = 0;
  bool extended = false;
  std::vector<std::uint8_t> data;  // of a length that exists
};

// All bits from start of frame to intermission; every receiver acknowledges in time.
std::size_t classic_bits_on_line(const LineFrame& frame);

// CRC-15 of the bits, polynomial 0x4599.
std::uint32_t crc15(const std::vector<bool>& bits);

struct FdBits {
  std::size_t slow = 0;  // up to and including BRS, and from the CRC delimiter on
  std::size_t fast = 0;
};

// The checksum itself has no influence: its stuff bits lie at fixed places.
FdBits fd_bits_on_line(const LineFrame& frame);

}  // namespace dottrack::test
