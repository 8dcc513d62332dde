#pragma once
// Counter-based random numbers: the n-th number of a stream is a pure function of (seed, stream,
// n), so neither threads nor the order of work can change it, and it is the same on every machine.

#include <cstdint>

namespace dottrack::host_sim {

// A bijection of 64-bit words that leaves no visible pattern (two multiply-xorshift rounds).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

constexpr std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
  return mix(mix(a) ^ b);
}

// [0, 1), from the upper 53 bits.
constexpr double unit_interval(std::uint64_t word) {
  return static_cast<double>(word >> 11U) * 0x1.0p-53;
}

// Draw more than one number in an expression only between braces, Vector2d{r.uniform(), ...}: the
// order of a call's arguments is the compiler's choice.
class RandomStream {
 public:
  constexpr RandomStream(std::uint64_t seed, std::uint64_t stream) : key_(mix(seed, stream)) {}

  constexpr std::uint64_t word() { return mix(key_, counter_++); }
  constexpr double uniform() { return unit_interval(word()); }
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

// Nearly normal, mean 0, variance 1, never beyond 4.9: the sum of eight 16-bit uniforms.
constexpr double nearly_normal(std::uint64_t a, std::uint64_t b) {
  std::int64_t sum = 0;
  for (unsigned shift = 0; shift < 64; shift += 16) {
    sum += static_cast<std::int64_t>((a >> shift) & 0xFFFFU);
    sum += static_cast<std::int64_t>((b >> shift) & 0xFFFFU);
  }
  constexpr double kMean = 8.0 * 65535.0 / 2.0;
  constexpr double kInverseSigma = 1.8688123650118534e-05;  // 1 / sqrt(8 (65536^2 - 1) / 12)
  return (static_cast<double>(sum) - kMean) * kInverseSigma;
}

}  // namespace dottrack::host_sim
