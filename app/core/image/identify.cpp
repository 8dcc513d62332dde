#include "app/core/image/identify.h"

#include <algorithm>
#include <array>
#include <limits>

#include "app/core/image/band_bitmap.h"
#include "app/core/image/bitmap.h"
#include "app/core/image/components.h"
#include "app/core/image/gates.h"
#include "app/core/image/judge.h"
#include "app/core/image/local_background.h"
#include "app/core/image/moments.h"
#include "app/core/image/region_sums.h"
#include "app/core/image/run_scan.h"
#include "app/core/image/small_components.h"

namespace dottrack::image {

namespace {

// One image's search: what is looked for, where.
struct Search {
  const ImageView& image;
  Window window;
  const Band& band;

  bool has_background() const { return band.min_contrast_dn > 0; }
  int width_px() const { return window.x_max - window.x_min + 1; }
  int height_px() const { return window.y_max - window.y_min + 1; }

  bool is_empty() const {
    return image.empty() || image.width_px > core::kMaxImageWidth ||
           image.height_px > core::kMaxImageHeight || width_px() <= 0 || height_px() <= 0 ||
           std::max(band.intensity_min_dn, 0) > std::min(band.intensity_max_dn, 255);
  }
  ImageView pixels() const {
    return {image.row(window.y_min) + window.x_min, width_px(), height_px(), image.stride_bytes};
  }
};

Window clipped(const Window& window, const ImageView& image) {
  return {std::max(window.x_min, 0), std::max(window.y_min, 0),
          std::min(window.x_max, image.width_px - 1), std::min(window.y_max, image.height_px - 1)};
}

// With thresholds, a pixel's value is by how much it goes beyond its own. Without, a pixel weighs
// one more than its distance from the near end of the band.
PixelWeights weights_of(const Band& band) {
  if (band.min_contrast_dn > 0) return {1, 0};
  if (band.polarity == core::Polarity::bright) return {1, 1 - std::max(band.intensity_min_dn, 0)};
  return {-1, 1 + std::min(band.intensity_max_dn, 255)};
}

// Behind the last pixel of any image.
constexpr PixelKey kNever = std::numeric_limits<PixelKey>::max();

Candidate candidate_of(const SmallComponent& small) {
  const auto x_max = static_cast<std::int16_t>(small.x_min + small.width_px - 1);
  const auto y_max = static_cast<std::int16_t>(small.y_min + small.height_px - 1);
  return {{0, Components::kEnd, Components::kEnd, small.area_px, small.x_min, x_max, small.y_min,
           y_max},
          small.bits};
}

}  // namespace

struct Identifier::Memory {
  // Candidates are measured a few at a time: the arithmetic of one is awaited behind the others'.
  static constexpr std::size_t kBatch = Moments::kCapacity;

  Thresholds thresholds_of(const Search& search) const {
    return search.has_background() ? background.thresholds() : Thresholds{};
  }
  // Of those that have not been judged.
  struct NextComponents {
    std::size_t small = 0;
    std::size_t large = 0;
  };

  int fill_rows(const Search& search, int y, int y_end);
  LinesAhead lines_after(const Search& search, int y) const;
  void find_components(const Search& search);
  IdentifyCounts pick_regions(const Search& search, const RegionGate& gate, Regions& regions);
  std::size_t next_batch(const SizeBounds& bounds, NextComponents& next, IdentifyCounts& counts);

  Bitmap bitmap;
  LocalBackground background;
  SmallComponents small;
  RunList runs;
  Components components;
  std::array<Candidate, kBatch> batch;
  std::array<RegionSums, kBatch> batch_sums;
  Moments moments;
};

Identifier::Identifier() : memory_(std::make_unique<Memory>()) {}
Identifier::~Identifier() = default;

std::size_t Identifier::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory);
}

// Those before row y_end of the window, or a few more; returns how many are filled.
int Identifier::Memory::fill_rows(const Search& search, int y, int y_end) {
  if (search.has_background()) return background.fill(y_end, bitmap);
  fill_band_rows(search.image, search.window, search.band, y, y_end, bitmap);
  return y_end;
}

// What the next rows to be filled need, but for what the present ones have sent for.
LinesAhead Identifier::Memory::lines_after(const Search& search, int y) const {
  const int from = search.has_background() ? background.next_row_px() : search.window.y_min + y + 2;
  const int rows = LocalBackground::kRowsAtATime - (search.has_background() ? 0 : 2);
  return {search.image, from, from + rows};
}

// A few rows at a time: while something is sought in them, the next ones come from memory. Small
// components first, then the runs that are left; where there is no room for a box, all are runs.
void Identifier::Memory::find_components(const Search& search) {
  constexpr int kSide = SmallComponent::kSide_px;
  const int height = search.height_px();
  const bool has_room = std::min(search.width_px(), height) >= kSide;
  bitmap.reshape(search.width_px(), height);
  small.clear();
  if (search.has_background()) background.start(search.image, search.window, search.band);
  for (int y = 0; y < height;) {
    y = fill_rows(search, y, std::min(y + LocalBackground::kRowsAtATime, height));
    if (!has_room) continue;
    small.take(bitmap, y < height ? y - kSide : height, lines_after(search, y));
  }
  if (has_room) small.finish(bitmap);
  runs.scan(bitmap, has_room ? small.groups_left() : bitmap.occupied());
  small.drop_from(runs.rows_searched());
  components.connect(runs);
}

// The next candidates that the cheap gates let through, in the order of their first pixels; returns
// how many.
std::size_t Identifier::Memory::next_batch(const SizeBounds& bounds, NextComponents& next,
                                           IdentifyCounts& counts) {
  std::size_t count = 0;
  const auto take = [&](const Candidate& candidate) {
    batch[count] = candidate;
    ++counts.components;
    const bool excluded = bounds.exclude(candidate.component);
    counts.rejected_size += excluded ? 1U : 0U;
    count += excluded ? 0U : 1U;
  };
  while (count < kBatch) {
    while (next.large < components.size() && !components.is_root(next.large)) ++next.large;
    const bool is_large = next.large < components.size();
    const PixelKey large_first = is_large ? runs[components[next.large].head].first : kNever;
    for (; next.small < small.size() && small[next.small].first < large_first && count < kBatch;
         ++next.small) {
      counts.runs += small[next.small].height_px;
      take(candidate_of(small[next.small]));
    }
    if (count == kBatch || !is_large) break;
    take({components[next.large++], 0});
  }
  return count;
}

IdentifyCounts Identifier::Memory::pick_regions(const Search& search, const RegionGate& gate,
                                                Regions& regions) {
  const ImageView pixels = search.pixels();
  const PixelWeights weights = weights_of(search.band);
  const Thresholds thresholds = thresholds_of(search);
  Window searched = search.window;
  searched.y_max = searched.y_min + runs.rows_searched() - 1;
  const SumsOf of{pixels, thresholds, search.band.polarity, runs, components};
  const SizeBounds bounds(gate);
  IdentifyCounts counts;
  counts.runs = static_cast<std::uint32_t>(runs.size());
  counts.overflow_runs = runs.overflow();
  NextComponents next;
  while (const std::size_t count = next_batch(bounds, next, counts)) {
    const std::span<const Candidate> candidates{batch.data(), count};
    const std::span<RegionSums> sums{batch_sums.data(), count};
    sum_regions(of, candidates, sums.data());
    measure(sums, weights, moments);
    judge({search.image, searched, of, weights, candidates, sums, moments}, gate, regions, counts);
  }
  return counts;
}

IdentifyCounts Identifier::identify(const ImageView& image, const Band& band,
                                    const RegionGate& gate, Regions& regions) {
  return identify(image, {0, 0, image.width_px - 1, image.height_px - 1}, band, gate, regions);
}

IdentifyCounts Identifier::identify(const ImageView& image, const Window& window, const Band& band,
                                    const RegionGate& gate, Regions& regions) {
  regions.clear();
  const Search search{image, clipped(window, image), band};
  if (search.is_empty()) return {};
  memory_->find_components(search);
  return memory_->pick_regions(search, gate, regions);
}

}  // namespace dottrack::image
