#include "app/core/image/small_components.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/image/small_components.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace dottrack::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::uint32_t, 8>;
using Bits = hn::Vec<Lanes>;
using Ints = hn::RebindToSigned<Lanes>;
constexpr Lanes kLanes;
constexpr Ints kInts;
constexpr std::size_t kMostVectors = 2;
constexpr std::size_t kVectorLanes = MaxLanes(kLanes);
static_assert(kMostVectors * kVectorLanes <= Beginnings::kMaxLanes);
constexpr int kRowBytes = Bitmap::kRowWords * static_cast<int>(sizeof(std::uint64_t));
constexpr int kSide = SmallComponent::kSide_px;

// What is seen of a row: 24 pixels around the beginning, which is at kMiddle. Nine and more to
// either side of it are too many.
constexpr int kMiddle = 10;
constexpr std::uint32_t kSeen = 0xFFFFFF;

HWY_INLINE Bits lowest(Bits v) {
  return hn::And(v, hn::Sub(hn::Zero(kLanes), v));
}

// The number of the highest set bit, through the exponent of a number below 2^24; 0 if there is
// none.
HWY_INLINE Bits number_of_highest(Bits v) {
  const Bits some = hn::Max(v, hn::Set(kLanes, 1U));
  const auto number = hn::ConvertTo(hn::RebindToFloat<Lanes>(), hn::BitCast(kInts, some));
  return hn::Sub(hn::ShiftRight<23>(hn::BitCast(kLanes, number)), hn::Set(kLanes, 127U));
}

// All bits up to the highest that is set.
HWY_INLINE Bits up_to_highest(Bits v) {
  v = hn::Or(v, hn::ShiftRight<1>(v));
  v = hn::Or(v, hn::ShiftRight<2>(v));
  v = hn::Or(v, hn::ShiftRight<4>(v));
  v = hn::Or(v, hn::ShiftRight<8>(v));
  return hn::Or(v, hn::ShiftRight<16>(v));
}

// The runs that hold the lowest of the bits in `touched`; none where that has none. Addition
// carries from that bit to the run's end; below it, a run begins behind the highest clear bit.
HWY_INLINE Bits run_at_lowest(Bits row, Bits touched) {
  const Bits from = lowest(touched);
  const Bits up = hn::And(hn::Xor(row, hn::Add(row, from)), row);
  const Bits below = hn::And(hn::Sub(from, hn::Set(kLanes, 1U)), hn::Set(kLanes, kSeen));
  // As if bit 0 were clear: a run that reaches it is too long.
  const Bits clear = hn::Or(hn::AndNot(row, below), hn::Set(kLanes, 1U));
  const Bits down = hn::AndNot(up_to_highest(clear), below);
  const auto none = hn::Eq(touched, hn::Zero(kLanes));
  return hn::IfThenZeroElse(none, hn::Or(up, down));
}

// Components side by side, each followed from its beginning. Two vectors at a time, where there are
// so many: the arithmetic of one is awaited behind the other's.
template <std::size_t kVectors>
class Followed {
 public:
  static constexpr std::size_t kLaneCount = kVectors * kVectorLanes;

  HWY_INLINE Followed(Bitmap& bitmap, const PixelKey* beginnings)
      : bytes_(reinterpret_cast<unsigned char*>(bitmap.row(0))) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      const auto pixel = hn::LoadU(kInts, beginnings + v * kVectorLanes);
      const auto seen_from = hn::Sub(pixel, hn::Set(kInts, kMiddle));
      seen_from_[v] = seen_from;
      offset_[v] = hn::ShiftRight<3>(seen_from);  // a row of bits is as long as its keys
      shift_[v] = hn::And(hn::BitCast(kLanes, seen_from), hn::Set(kLanes, 7U));
    }
  }

  HWY_INLINE void follow() {
    for (std::size_t v = 0; v < kVectors; ++v) begin(v);
    for (int r = 0; r < kSide; ++r) {
      for (std::size_t v = 0; v < kVectors; ++v) step(v, r);
    }
    for (std::size_t v = 0; v < kVectors; ++v) conclude(v);
  }

  // Clears those of the first `count` that are taken, and writes them to `to`; returns how many.
  HWY_INLINE std::size_t take(std::size_t count, SmallComponent* to) const {
    Columns columns;
    for (std::size_t v = 0; v < kVectors; ++v) write(v, columns);
    SmallComponent* next = to;
    for (std::size_t i = 0; i < count; ++i) {
      clear(columns, i);
      const PixelKey first = columns.first[i];
      next->bits = columns.upper[i] | std::uint64_t{columns.lower[i]} << 32U;
      next->first = first;
      next->x_min = static_cast<std::int16_t>(column(columns.corner[i]));
      next->y_min = static_cast<std::int16_t>(dottrack::image::row(first));
      next->width_px = static_cast<std::uint8_t>(columns.width[i]);
      next->height_px = static_cast<std::uint8_t>(columns.height[i]);
      // Counted here, where it is one instruction.
      next->area_px = static_cast<std::uint8_t>(std::popcount(next->bits));
      next += columns.taken[i] & 1U;
    }
    return static_cast<std::size_t>(next - to);
  }

 private:
  using Numbers = std::uint32_t[kLaneCount];
  struct Columns {
    std::int32_t offset[kLaneCount];
    PixelKey first[kLaneCount];
    PixelKey corner[kLaneCount];  // column of the bounding box
    Numbers width, height, upper, lower, taken;
    Numbers keep[kSide];
  };

  HWY_INLINE Bits row(std::size_t v, int r) const {
    const auto* base = reinterpret_cast<const std::uint32_t*>(bytes_ + r * kRowBytes);
    const Bits bits = hn::GatherOffset(kLanes, base, offset_[v]);
    return hn::And(hn::Shr(bits, shift_[v]), hn::Set(kLanes, kSeen));
  }

  HWY_INLINE void begin(std::size_t v) {
    const Bits middle = hn::Set(kLanes, 1U << static_cast<unsigned>(kMiddle));
    here_[v] = row(v, 0);
    run_[v] = run_at_lowest(here_[v], middle);
    all_[v] = run_[v];
    height_[v] = hn::Zero(kLanes);
    // Followed before from another beginning, or it began further up.
    amiss_[v] = hn::Or(hn::AndNot(here_[v], middle), hn::And(row(v, -1), run_[v]));
  }

  HWY_INLINE void step(std::size_t v, int r) {
    const Bits run = run_[v];
    runs_[r][v] = run;
    const auto some = hn::VecFromMask(kLanes, hn::Ne(run, hn::Zero(kLanes)));
    height_[v] = hn::Sub(height_[v], some);
    const Bits below = row(v, r + 1);
    const Bits touched = hn::And(below, run);
    const Bits next = run_at_lowest(below, touched);
    // Another run touches this one from below, or the next one from above.
    const Bits others = hn::Or(hn::AndNot(next, touched), hn::AndNot(run, hn::And(here_[v], next)));
    amiss_[v] = hn::Or(amiss_[v], others);
    all_[v] = hn::Or(all_[v], next);
    here_[v] = below;
    run_[v] = next;
  }

  HWY_INLINE void conclude(std::size_t v) {
    left_[v] = number_of_highest(lowest(all_[v]));
    width_[v] = hn::Add(hn::Sub(number_of_highest(all_[v]), left_[v]), hn::Set(kLanes, 1U));
    // The ninth row must have none.
    const auto none_amiss = hn::Eq(hn::Or(amiss_[v], run_[v]), hn::Zero(kLanes));
    const auto narrow = hn::Lt(width_[v], hn::Set(kLanes, kSide + 1U));
    taken_[v] = hn::And(hn::VecFromMask(kLanes, none_amiss), hn::VecFromMask(kLanes, narrow));
  }

  HWY_INLINE void write(std::size_t v, Columns& to) const {
    const std::size_t at = v * kVectorLanes;
    Bits half[2] = {hn::Zero(kLanes), hn::Zero(kLanes)};
    for (int r = kSide - 1; r >= 0; --r) {
      const Bits cleared = hn::And(taken_[v], hn::Shl(runs_[r][v], shift_[v]));
      hn::StoreU(hn::Not(cleared), kLanes, to.keep[r] + at);
      half[r / 4] = hn::Or(hn::ShiftLeft<8>(half[r / 4]), hn::Shr(runs_[r][v], left_[v]));
    }
    const auto first = number_of_highest(lowest(runs_[0][v]));
    hn::StoreU(offset_[v], kInts, to.offset + at);
    hn::StoreU(hn::Add(seen_from_[v], hn::BitCast(kInts, first)), kInts, to.first + at);
    hn::StoreU(hn::Add(seen_from_[v], hn::BitCast(kInts, left_[v])), kInts, to.corner + at);
    hn::StoreU(width_[v], kLanes, to.width + at);
    hn::StoreU(height_[v], kLanes, to.height + at);
    hn::StoreU(half[0], kLanes, to.upper + at);
    hn::StoreU(half[1], kLanes, to.lower + at);
    hn::StoreU(taken_[v], kLanes, to.taken + at);
  }

  HWY_INLINE void clear(const Columns& columns, std::size_t i) const {
    for (int r = 0; r < kSide; ++r) {
      unsigned char* const at = bytes_ + columns.offset[i] + r * kRowBytes;
      std::uint32_t bits;
      std::memcpy(&bits, at, sizeof(bits));
      bits &= columns.keep[r][i];
      std::memcpy(at, &bits, sizeof(bits));
    }
  }

  unsigned char* bytes_;
  hn::Vec<Ints> seen_from_[kVectors];
  hn::Vec<Ints> offset_[kVectors];
  Bits shift_[kVectors];
  Bits here_[kVectors], run_[kVectors], all_[kVectors], amiss_[kVectors];
  Bits runs_[kSide][kVectors];
  Bits left_[kVectors], width_[kVectors], height_[kVectors], taken_[kVectors];
};

template <std::size_t kVectors>
HWY_INLINE std::size_t follow(Bitmap& bitmap, const PixelKey* beginnings, std::size_t count,
                              SmallComponent* to) {
  Followed<kVectors> followed(bitmap, beginnings);
  followed.follow();
  return followed.take(count, to);
}

// So many of the beginnings as fill all lanes, or all of them, until there is no room; returns how
// many components.
std::size_t follow_beginnings(Bitmap& bitmap, bool all, Beginnings& beginnings, SmallComponent* to,
                              const SmallComponent* end) {
  constexpr std::size_t kLaneCount = kMostVectors * kVectorLanes;
  SmallComponent* next = to;
  std::size_t i = 0;
  while (beginnings.size - i >= (all ? 1 : kLaneCount) && next < end) {
    const std::size_t count = std::min(beginnings.size - i, kLaneCount);
    const PixelKey* const pixels = beginnings.pixels.data() + i;
    next += count > kVectorLanes ? follow<kMostVectors>(bitmap, pixels, count, next)
                                 : follow<1>(bitmap, pixels, count, next);
    i += count;
  }
  if (next >= end) i = beginnings.size;
  const PixelKey* rest = beginnings.pixels.data() + i;
  std::copy(rest, rest + (beginnings.size - i), beginnings.pixels.data());
  beginnings.size -= i;
  return static_cast<std::size_t>(next - to);
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::image {

HWY_EXPORT(follow_beginnings);

void SmallComponents::clear() {
  size_ = 0;
  beginnings_.size = 0;
  groups_taken_ = 0;
  groups_listed_ = 0;
  left_count_ = 0;
}

void SmallComponents::take(Bitmap& bitmap, int y_end, LinesAhead ahead) {
  const std::size_t end = bitmap.groups_before(y_end);
  while (groups_taken_ < end) {
    const std::size_t count = std::min(end - groups_taken_, Beginnings::kMaxGroups);
    find_beginnings(bitmap, bitmap.occupied().subspan(groups_taken_, count),
                    connected_.data() + groups_taken_ * Bitmap::kGroupWords, ahead, beginnings_);
    groups_taken_ += count;
    size_ += HWY_DYNAMIC_DISPATCH(follow_beginnings)(
        bitmap, false, beginnings_, components_.data() + size_, components_.data() + kCapacity);
  }
  const int y_settled = beginnings_.size > 0 ? row(beginnings_.pixels[0]) : y_end;
  list_left(bitmap, bitmap.groups_before(y_settled));
}

void SmallComponents::finish(Bitmap& bitmap) {
  size_ += HWY_DYNAMIC_DISPATCH(follow_beginnings)(
      bitmap, true, beginnings_, components_.data() + size_, components_.data() + kCapacity);
  list_left(bitmap, groups_taken_);
}

void SmallComponents::drop_from(int y) {
  while (size_ > 0 && components_[size_ - 1].first >= y * kRowStep) --size_;
}

void SmallComponents::list_left(const Bitmap& bitmap, std::size_t group_end) {
  const std::size_t count = group_end - groups_listed_;
  left_count_ += list_groups_left(bitmap, bitmap.occupied().subspan(groups_listed_, count),
                                  connected_.data() + groups_listed_ * Bitmap::kGroupWords,
                                  left_.data() + left_count_);
  groups_listed_ = group_end;
}

}  // namespace dottrack::image
#endif
