#pragma once
// From measured values to the raw numbers of signals. Nothing here calls a library whose last bit
// could differ from machine to machine.

#include <bit>
#include <cstdint>

#include "app/core/protocol/layout_types.h"

namespace dottrack::protocol {

// The nearest integer, of two the even one; |value| below 2^51. The sum has no bits left below one:
// its mantissa is the integer.
constexpr std::int64_t nearest(double value) {
  constexpr double kShift = 0x1.8p52;
  return std::bit_cast<std::int64_t>(value + kShift) - std::bit_cast<std::int64_t>(kShift);
}

// The least raw number whose value, as a reader computes it, is no less than this one.
constexpr std::int64_t rounded_up(const layout::Signal& signal, double value) {
  const std::int64_t raw = nearest(value * signal.steps_per_unit());
  return static_cast<double>(raw) * signal.factor < value ? raw + 1 : raw;
}

// Of a value that is 0 or more; NaN and what is beyond the signal's range are not available.
constexpr std::uint64_t raw_rounded_up(const layout::Signal& signal, double value) {
  if (!(value >= 0.0 && value <= static_cast<double>(signal.largest()) * signal.factor)) {
    return signal.not_available();
  }
  return static_cast<std::uint64_t>(rounded_up(signal, value));
}

// Written so that NaN does not fit.
constexpr bool fits(const layout::Signal& signal, double value) {
  const double largest = static_cast<double>(signal.largest()) * signal.factor;
  return value >= -largest && value <= largest;
}

// Of a value that fits.
constexpr std::uint64_t raw_nearest(const layout::Signal& signal, double value) {
  return static_cast<std::uint64_t>(nearest(value * signal.steps_per_unit()));
}

}  // namespace dottrack::protocol
