#include "app/core/acquisition/pair_filter.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/core/acquisition/pair_filter.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, by its rules.
#include <hwy/highway.h>

namespace dottrack::acquisition {
void sort_many(std::uint16_t* hits, std::size_t n);
}

HWY_BEFORE_NAMESPACE();
namespace dottrack::acquisition {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kSpareLanes>;

// Writes the positions of b's rays in the window that suit a's ray i, and returns how many.
HWY_INLINE std::size_t look(const PencilRays& a, std::size_t i, const SortedRays& b,
                            const SortedRays::Window& window, std::uint16_t* hits) {
  const Lanes lanes;
  const auto angle = hn::Set(lanes, a.angle[i]);
  const auto half_width = hn::Set(lanes, a.half_width[i]);
  const auto cotangent = hn::Set(lanes, a.cotangent[i]);
  const auto low = hn::Set(lanes, a.low[i]);
  const auto high = hn::Set(lanes, a.high[i]);
  const auto slope = hn::Set(lanes, a.miss_slope[i]);
  const auto offset = hn::Set(lanes, a.miss_offset[i]);
  std::size_t found = 0;
  for (std::size_t k = window.first; k < window.last; k += hn::Lanes(lanes)) {
    const auto between = hn::Abs(hn::Sub(hn::LoadU(lanes, &b.angle[k]), angle));
    const auto other = hn::LoadU(lanes, &b.cotangent[k]);
    const auto width = hn::Min(half_width, hn::LoadU(lanes, &b.half_width[k]));
    const auto miss = hn::Add(hn::Mul(slope, hn::Add(cotangent, other)), offset);
    const auto near =
        hn::And(hn::Le(between, hn::Min(width, miss)), hn::FirstN(lanes, window.last - k));
    const auto a_suits = hn::And(hn::Ge(cotangent, hn::LoadU(lanes, &b.low[k])),
                                 hn::Le(cotangent, hn::LoadU(lanes, &b.high[k])));
    const auto b_suits = hn::And(hn::Ge(other, low), hn::Le(other, high));
    const auto suits = hn::And(near, hn::And(a_suits, b_suits));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(lanes, suits, bytes);
    for (unsigned bits = bytes[0]; bits != 0; bits &= bits - 1) {
      hits[found++] = b.index[k + static_cast<std::size_t>(__builtin_ctz(bits))];
    }
  }
  return found;
}

HWY_INLINE void order(std::uint16_t& a, std::uint16_t& b) {
  const std::uint16_t less = a < b ? a : b;
  b = a < b ? b : a;
  a = less;
}

constexpr std::size_t kLeastSorted = 4;

// Most rows have one hit or none, and some a few: these are sorted without branches. What is beyond
// them is overwritten.
HWY_INLINE void sort_hits(std::uint16_t* hits, std::size_t n) {
  if (n < 2) return;
  if (n > kLeastSorted) return sort_many(hits, n);
  for (std::size_t k = n; k < n + kLeastSorted; ++k) hits[k] = 0xFFFF;
  order(hits[0], hits[1]);
  order(hits[2], hits[3]);
  order(hits[0], hits[2]);
  order(hits[1], hits[3]);
  order(hits[1], hits[2]);
}

// Rows [from, to) of a, or as many of them as there is room for; returns where it stopped.
std::size_t look_in_rows(const PencilRays& a, const SortedRays& b, std::size_t from, std::size_t to,
                         const PairFilter::Room& room) {
  std::size_t looked_at = 0;
  std::size_t hits = 0;
  std::size_t i = from;
  for (; i < to && hits + b.size + kLeastSorted <= room.hits.size() && looked_at <= room.looks;
       ++i) {
    PairFilter::Row& row = room.rows[i];
    row = {};
    row.first_hit = static_cast<std::uint16_t>(hits);
    if (a.is_stray(i)) continue;
    const SortedRays::Window window = b.window(a.angle[i], a.half_width[i]);
    if (window.first == window.last) continue;
    const std::size_t found = look(a, i, b, window, room.hits.data() + hits);
    sort_hits(room.hits.data() + hits, found);
    hits += found;
    looked_at += window.last - window.first;
    row.hits = static_cast<std::uint16_t>(found);
    row.looked_at = static_cast<std::uint16_t>(window.last - window.first);
  }
  return i;
}

}  // namespace HWY_NAMESPACE
}  // namespace dottrack::acquisition
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dottrack::acquisition {

HWY_EXPORT(look_in_rows);

// For some ten numbers: insertion; they come in a few ascending runs.
void sort_many(std::uint16_t* hits, std::size_t n) {
  if (n > 32) return std::sort(hits, hits + n);
  for (std::size_t k = 1; k < n; ++k) {
    const std::uint16_t hit = hits[k];
    std::size_t at = k;
    for (; at > 0 && hits[at - 1] > hit; --at) hits[at] = hits[at - 1];
    hits[at] = hit;
  }
}

bool PairFilter::start(const RayArrays& a, const RayArrays& b, double max_miss_m) {
  rays_a_ = &a;
  rays_b_ = &b;
  const Pencil pencil(a, b, max_miss_m);
  if (!pencil.has_baseline()) return false;
  reach_m_ = static_cast<float>(pencil.max_miss_m + pencil.origin_offset_m +
                                static_cast<double>(kRoundingPart) * pencil.baseline_m);
  unfold(pencil, PencilEnd::a, a, a_);
  unfold(pencil, PencilEnd::b, b, b_);
  sort(b_, b.size, sorted_b_);
  return true;
}

std::span<const PairFilter::Row> PairFilter::rows(std::size_t from) {
  const bool strays = !a_.stray.empty() || !b_.stray.empty();
  const std::size_t size = rays_a_->size;
  const std::size_t to = strays ? std::min(from + 1, size) : size;
  const std::size_t end =
      HWY_DYNAMIC_DISPATCH(look_in_rows)(a_, sorted_b_, from, to, {rows_, hits_, kLooksInOneGo});
  if (strays && from < end) add_strays(from, rows_[from]);
  return std::span<const Row>(rows_).subspan(from, end - from);
}

// A stray ray of either camera may belong to any ray that comes as close to the baseline.
void PairFilter::add_strays(std::size_t i, Row& row) {
  const auto look_at = [&](std::size_t j) {
    ++row.looked_at;
    if (!may_meet(i, j)) return;
    hits_[row.first_hit + row.hits++] = static_cast<std::uint16_t>(j);
  };
  if (a_.is_stray(i)) {
    for (std::size_t j = 0; j < rays_b_->size; ++j) look_at(j);
  } else {
    for (const std::uint16_t j : b_.stray) look_at(j);
  }
  const auto first = hits_.begin() + row.first_hit;
  std::sort(first, first + row.hits);
}

bool PairFilter::may_meet(std::size_t i, std::size_t j) const {
  const float near_a = rays_a_->near_m[i];
  const float far_a = rays_a_->far_m[i];
  const float near_b = rays_b_->near_m[j];
  const float far_b = rays_b_->far_m[j];
  const float reach_m = reach_m_ + kRoundingPart * (far_a + far_b);
  return near_a <= far_a && near_b <= far_b &&
         near_a * a_.sine[i] <= far_b * b_.sine[j] + reach_m &&
         near_b * b_.sine[j] <= far_a * a_.sine[i] + reach_m;
}

}  // namespace dottrack::acquisition
#endif
