#include "app/core/image_fingerprint.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image_fingerprint.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::core {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// So that it costs a few hundredths of finding the regions.
constexpr int kRowStep = 16;
// What is added to a word counts up by this from word to word: an odd number with no pattern.
constexpr std::uint32_t kKeyStep = 0x9E3779B9U;
constexpr std::size_t kBlock_bytes = 32;  // what is left of a row does not count
// Rows so far apart lie on pages of their own, and nothing but this sends for them in time.
constexpr int kAhead = 4 * kRowStep;

// The sum of the products of neighbouring words, each with a key of its place added: nothing waits
// for anything. A change of one word changes its product, but where the other and its key are 0.
#if HWY_TARGET == HWY_SCALAR
std::uint64_t sum_products(const ImageView& image) {
  const auto row_bytes = static_cast<std::size_t>(image.width_px) / kBlock_bytes * kBlock_bytes;
  std::uint32_t key = kKeyStep;
  std::uint64_t sum = 0;
  for (int y = 0; y < image.height_px; y += kRowStep) {
    for (std::size_t i = 0; i < row_bytes; i += 8) {
      std::uint32_t words[2];
      std::memcpy(words, image.row(y) + i, sizeof words);
      sum += std::uint64_t{words[0] + key} * (words[1] + key + kKeyStep);
      key += 2 * kKeyStep;
    }
  }
  return sum;
}
#else
std::uint64_t sum_products(const ImageView& image) {
  const hn::CappedTag<std::uint32_t, kBlock_bytes / 4> words;
  const hn::RepartitionToWide<decltype(words)> sums;
  const hn::Repartition<std::uint8_t, decltype(words)> bytes;
  const auto row_bytes = static_cast<std::size_t>(image.width_px) / kBlock_bytes * kBlock_bytes;
  const auto step = hn::Set(words, static_cast<std::uint32_t>(hn::Lanes(words)) * kKeyStep);
  auto key = hn::Mul(hn::Iota(words, 1), hn::Set(words, kKeyStep));
  auto sum = hn::Zero(sums);
  for (int y = 0; y < image.height_px; y += kRowStep) {
    const std::uint8_t* const row = image.row(y);
    const std::uint8_t* const later = image.row(std::min(y + kAhead, image.height_px - 1));
    for (std::size_t i = 0; i < row_bytes; i += hn::Lanes(bytes)) {
      hwy::Prefetch(later + i);
      const auto word = hn::Add(hn::BitCast(words, hn::LoadU(bytes, row + i)), key);
      const auto other = hn::BitCast(words, hn::ShiftRight<32>(hn::BitCast(sums, word)));
      sum = hn::Add(sum, hn::MulEven(word, other));
      key = hn::Add(key, step);
    }
  }
  return hn::GetLane(hn::SumOfLanes(sums, sum));
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::core
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::core {

HWY_EXPORT(sum_products);

std::uint64_t fingerprint(const ImageView& image) {
  return HWY_DYNAMIC_DISPATCH(sum_products)(image);
}

}  // namespace dottrack::core
#endif
