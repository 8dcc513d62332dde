#include "tests/unit/bus_load/bit_stream.h"

namespace dottrack::test {
namespace {

using Bits = std::vector<bool>;

void append(Bits& bits, std::uint32_t value, unsigned count) {
  for (unsigned i = count; i-- > 0;) bits.push_back(((value >> i) & 1U) != 0);
}

void append(Bits& bits, const std::vector<std::uint8_t>& data) {
  for (const std::uint8_t byte : data) append(bits, byte, 8);
}

// Start of frame, and the identifier with the bits among it: a 29-bit one comes as 11, SRR,
// IDE, 18.
Bits start(const LineFrame& frame) {
  Bits bits{false};
  if (!frame.extended) {
    append(bits, frame.id, 11);
    return bits;
  }
  append(bits, frame.id >> 18U, 11);
  append(bits, 0b11, 2);
  append(bits, frame.id & 0x3FFFFU, 18);
  return bits;
}

std::uint32_t length_code(std::size_t bytes) {
  constexpr std::size_t kLong[] = {12, 16, 20, 24, 32, 48, 64};
  if (bytes <= 8) return static_cast<std::uint32_t>(bytes);
  std::uint32_t code = 9;
  for (const std::size_t length : kLong) {
    if (length >= bytes) break;
    ++code;
  }
  return code;
}

// Calls `place` with the number of bits before each stuff bit.
template <typename Place>
void stuff(const Bits& bits, Place place) {
  bool last = !bits.front();
  unsigned run = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    run = bits[i] == last ? run + 1 : 1;
    last = bits[i];
    if (run < 5) continue;
    place(i + 1);
    last = !last;
    run = 1;
  }
}

}  // namespace

std::uint32_t crc15(const std::vector<bool>& bits) {
  std::uint32_t crc = 0;
  for (const bool bit : bits) {
    const bool high = (crc & 0x4000U) != 0;
    crc = (crc << 1U) & 0x7FFFU;
    if (bit != high) crc ^= 0x4599U;
  }
  return crc;
}

std::size_t classic_bits_on_line(const LineFrame& frame) {
  Bits bits = start(frame);
  append(bits, 0, 3);  // RTR, IDE, FDF or RTR, FDF, r0
  append(bits, length_code(frame.data.size()), 4);
  append(bits, frame.data);
  append(bits, crc15(bits), 15);
  std::size_t count = bits.size();
  stuff(bits, [&](std::size_t) { ++count; });
  const std::size_t delimiters = 1 + 1 + 1;  // CRC delimiter, ACK, ACK delimiter
  const std::size_t end = 7;
  const std::size_t intermission = 3;
  return count + delimiters + end + intermission;
}

FdBits fd_bits_on_line(const LineFrame& frame) {
  Bits bits = start(frame);
  // RRS, then IDE if it has not been yet, FDF, reserved, BRS.
  append(bits, frame.extended ? 0b0101 : 0b00101, frame.extended ? 4 : 5);
  const std::size_t head = bits.size();
  append(bits, 0, 1);  // ESI
  append(bits, length_code(frame.data.size()), 4);
  append(bits, frame.data);
  FdBits count{.slow = head, .fast = bits.size() - head};
  stuff(bits, [&](std::size_t place) {
    if (place == bits.size()) return;  // the fixed stuff bit that is next serves for it
    ++(place < head ? count.slow : count.fast);
  });
  const std::size_t checksum = 4 + (frame.data.size() <= 16 ? 17U : 21U);
  for (std::size_t i = 0; i < checksum; ++i) count.fast += i % 4 == 0 ? 2U : 1U;
  count.slow += 1 + 1 + 1 + 7 + 3;
  return count;
}

}  // namespace dottrack::test
