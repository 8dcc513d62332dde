#include "app/core/image/dot_pixels.h"

#include <bit>
#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/dot_pixels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, DotPixels::kBlock>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes kLanes;
constexpr int kStep = static_cast<int>(MaxLanes(Lanes()));

HWY_INLINE Vector all(int value) {
  return hn::Set(kLanes, static_cast<float>(value));
}

HWY_INLINE Vector grey_of(const std::uint8_t* pixels) {
  const hn::Rebind<std::int32_t, Lanes> wide;
  const hn::Rebind<std::uint8_t, Lanes> bytes;
  return hn::ConvertTo(kLanes, hn::PromoteTo(wide, hn::LoadU(bytes, pixels)));
}

HWY_INLINE void append(Vector x, Vector y, Vector grey, int at, DotPixels& pixels) {
  hn::StoreU(x, kLanes, pixels.x.data() + at);
  hn::StoreU(y, kLanes, pixels.y.data() + at);
  hn::StoreU(grey, kLanes, pixels.grey.data() + at);
}

// Appends n pixels of row y from column `start` on; returns how many there are then.
HWY_INLINE int append_run(const std::uint8_t* row, int y, int start, int n, int count,
                          DotPixels& pixels) {
  const Vector next = all(kStep);
  const Vector down = all(y);
  Vector x = hn::Iota(kLanes, static_cast<float>(start));
  for (int k = 0; k < n; k += kStep) {
    append(x, down, grey_of(row + start + k), count + k, pixels);
    x = hn::Add(x, next);
  }
  return count + n;
}

bool list(const ImageView& patch, const PatchRows& rows, DotPixels& pixels) {
  if (rows.inner.places.n > DotPixels::kCapacity) return false;
  const std::uint8_t* row = patch.data;
  int count = 0;
  for (int y = 0; y < rows.count; ++y, row += patch.stride_bytes) {
    const int start = rows.inner.before[static_cast<std::size_t>(y)] + 1;
    const int n = rows.inner.after[static_cast<std::size_t>(y)] - start;
    if (n > 0) count = append_run(row, y, start, n, count, pixels);
  }
  pixels.count = count;
  pixels.close();
  return true;
}

void list_map(const ImageView& patch, const PixelMap& map, DotPixels& pixels) {
  int count = 0;
  for (int y = 0; y < patch.height_px; ++y) {
    std::uint64_t left = map[static_cast<std::size_t>(y)];
    while (left != 0) {
      const int start = std::countr_zero(left);
      const std::uint64_t filled = left | (left - 1);
      const int n = std::countr_one(filled) - start;
      count = append_run(patch.row(y), y, start, n, count, pixels);
      left &= filled + 1;
    }
  }
  pixels.count = count;
  pixels.close();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(list);
HWY_EXPORT(list_map);

bool list_pixels(const ImageView& patch, const PatchRows& rows, DotPixels& pixels) {
  return HWY_DYNAMIC_DISPATCH(list)(patch, rows, pixels);
}

void list_pixels(const ImageView& patch, const PixelMap& map, DotPixels& pixels) {
  HWY_DYNAMIC_DISPATCH(list_map)(patch, map, pixels);
}

}  // namespace dottrack::image
#endif
