#include "app/core/image/ring_level.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace dottrack::image {
namespace {

constexpr int kGreys = 256;
constexpr int kMinPixels = 20;
constexpr double kShare = 0.4;
constexpr double kShareSigmas = 1.05;  // width of the middle two fifths of a normal distribution

struct Histogram {
  std::array<std::uint16_t, kGreys> of{};
  int count = 0;
  int darkest = kGreys - 1;
  int brightest = 0;

  // Pixels of columns x with before < x < after.
  void add(const std::uint8_t* pixels, int before, int after) {
    for (int x = before + 1; x < after; ++x) {
      ++of[pixels[x]];
      darkest = std::min<int>(darkest, pixels[x]);
      brightest = std::max<int>(brightest, pixels[x]);
    }
    count += std::max(after - before - 1, 0);
  }
};

Histogram histogram_of(const ImageView& patch, const PatchRows& rows) {
  Histogram histogram;
  for (int y = 0; y < rows.count; ++y) {
    const auto row = static_cast<std::size_t>(y);
    const int before = rows.outer.before[row];
    const int after = rows.outer.after[row];
    const int dot_before = rows.inner.before[row];
    const int dot_after = rows.inner.after[row];
    if (dot_after <= dot_before + 1) {
      histogram.add(patch.row(y), before, after);
    } else {
      histogram.add(patch.row(y), before, dot_before + 1);
      histogram.add(patch.row(y), dot_after - 1, after);
    }
  }
  return histogram;
}

}  // namespace

// The darkest of equally short intervals, so that one thing decides.
bool find_level(const ImageView& patch, const PatchRows& rows, RingLevel& level) {
  const Histogram histogram = histogram_of(patch, rows);
  if (histogram.count < kMinPixels) return false;
  const int wanted = static_cast<int>(kShare * histogram.count);
  int shortest = kGreys + 1;
  int held = 0;
  int begin = histogram.darkest;
  for (int end = histogram.darkest; end <= histogram.brightest; ++end) {
    if (histogram.of[static_cast<std::size_t>(end)] == 0) continue;  // only longer than before
    held += histogram.of[static_cast<std::size_t>(end)];
    while (held - histogram.of[static_cast<std::size_t>(begin)] >= wanted) {
      held -= histogram.of[static_cast<std::size_t>(begin)];
      ++begin;
    }
    if (held < wanted || end - begin + 1 >= shortest) continue;
    shortest = end - begin + 1;
    level.middle_dn = 0.5 * (begin + end);
  }
  level.sigma_dn = shortest / kShareSigmas;
  return true;
}

}  // namespace dottrack::image
