#pragma once
// Identify as one would write it without a thought for speed: a flood fill and direct sums.

#include <vector>

#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"

namespace dottrack::image::test {

struct PlainResult {
  IdentifyCounts counts;
  std::vector<Region> regions;
};

PlainResult plain_identify(const Picture& picture, const Window& window, const Band& band,
                           const RegionGate& gate);

// The whole picture.
Window whole(const Picture& picture);

// Every field, floating-point ones within a tolerance that rounding explains. Counts into
// `comparisons` the regions it compared.
void expect_equal(const PlainResult& expected, const IdentifyCounts& counts, const Regions& regions,
                  int& comparisons);

}  // namespace dottrack::image::test
