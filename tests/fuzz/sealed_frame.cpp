#include "tests/fuzz/sealed_frame.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace dottrack::fuzz {
namespace {

constexpr std::uint8_t kClassicLength = 8;
constexpr std::uint8_t kFdLength = 64;
constexpr unsigned kPolynomial8 = 0x2F;
constexpr unsigned kPolynomial16 = 0x1021;
constexpr std::uint8_t kFdDataId[] = {0x7A, 0xD0};

unsigned crc8(unsigned crc, std::uint8_t byte) {
  crc ^= byte;
  for (int bit = 0; bit < 8; ++bit) {
    crc = (crc & 0x80U) != 0 ? (crc << 1U ^ kPolynomial8) & 0xFFU : crc << 1U;
  }
  return crc;
}

unsigned crc16(unsigned crc, std::uint8_t byte) {
  crc ^= static_cast<unsigned>(byte) << 8U;
  for (int bit = 0; bit < 8; ++bit) {
    crc = (crc & 0x8000U) != 0 ? (crc << 1U ^ kPolynomial16) & 0xFFFFU : crc << 1U;
  }
  return crc;
}

void seal_classic(dottrack_frame& frame, std::uint32_t offset) {
  unsigned crc = 0xFF;
  for (std::size_t i = 1; i < kClassicLength; ++i) crc = crc8(crc, frame.data[i]);
  crc = crc8(crc, static_cast<std::uint8_t>(offset + 1));
  frame.data[0] = static_cast<std::uint8_t>(crc ^ 0xFFU);
}

void seal_fd(dottrack_frame& frame) {
  unsigned crc = 0xFFFF;
  for (std::size_t i = 2; i < kFdLength; ++i) crc = crc16(crc, frame.data[i]);
  for (const std::uint8_t byte : kFdDataId) crc = crc16(crc, byte);
  frame.data[0] = static_cast<std::uint8_t>(crc & 0xFFU);
  frame.data[1] = static_cast<std::uint8_t>(crc >> 8U);
}

}  // namespace

void seal(dottrack_frame& frame, std::uint32_t offset) {
  if (frame.length == kClassicLength) seal_classic(frame, offset);
  if (frame.length == kFdLength) seal_fd(frame);
}

bool is_sealed(const dottrack_frame& frame, std::uint32_t offset) {
  if (frame.length != (offset == kFdPoseOffset ? kFdLength : kClassicLength)) return false;
  dottrack_frame sealed = frame;
  seal(sealed, offset);
  return std::equal(std::begin(sealed.data), std::end(sealed.data), std::begin(frame.data));
}

}  // namespace dottrack::fuzz
