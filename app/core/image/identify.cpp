#include "app/core/image/identify.h"

#include <algorithm>
#include <numbers>

#include "app/core/image/band_bitmap.h"
#include "app/core/image/bitmap.h"
#include "app/core/image/components.h"
#include "app/core/image/local_background.h"
#include "app/core/image/region_moments.h"
#include "app/core/image/run_scan.h"

namespace dottrack::image {

struct Identifier::Memory {
  void find_components(const ImageView& image, const Window& window, const Band& band);
  void take_rows(int y_end);

  Bitmap bitmap;
  LocalBackground background;
  RunList runs;
  Components components;
};

Identifier::Identifier() : memory_(std::make_unique<Memory>()) {}
Identifier::~Identifier() = default;

std::size_t Identifier::footprint_bytes() const {
  return sizeof(*this) + sizeof(Memory);
}

namespace {

bool fits(const ImageView& image) {
  return !image.empty() && image.width_px <= core::kMaxImageWidth &&
         image.height_px <= core::kMaxImageHeight;
}

Window clipped(const Window& window, const ImageView& image) {
  return {std::max(window.x_min, 0), std::max(window.y_min, 0),
          std::min(window.x_max, image.width_px - 1), std::min(window.y_max, image.height_px - 1)};
}

// Without a local background, a pixel weighs one more than its distance from the near end of the
// band.
PixelWeights band_weights(const ImageView& pixels, const Band& band) {
  if (band.polarity == core::Polarity::bright) {
    return {pixels, 1, 1 - std::max(band.intensity_min_dn, 0)};
  }
  return {pixels, -1, 1 + std::min(band.intensity_max_dn, 255)};
}

bool in_size(const RegionGate& gate, const Region& region) {
  return region.semi_major_px >= gate.semi_major_min_px &&
         region.semi_major_px <= gate.semi_major_max_px;
}

// Area over the area of the ellipse with the same moments: 1 for an ellipse, less for all else.
double fill(const Region& region) {
  return region.area_px / (std::numbers::pi * region.semi_major_px * region.semi_minor_px);
}

bool in_shape(const RegionGate& gate, const Region& region) {
  return region.semi_minor_px >= gate.min_axis_ratio * region.semi_major_px &&
         fill(region) >= gate.min_fill && region.core_contrast_dn >= gate.min_core_contrast_dn;
}

void count_and_keep(const Region& region, const RegionGate& gate, IdentifyCounts& counts,
                    Regions& regions) {
  if (!in_size(gate, region)) {
    ++counts.rejected_size;
  } else if (!in_shape(gate, region)) {
    ++counts.rejected_shape;
  } else if (try_push_back(regions, region)) {
    ++counts.accepted;
  } else {
    ++counts.overflow_regions;
  }
}

}  // namespace

void Identifier::Memory::take_rows(int y_end) {
  runs.scan(bitmap, y_end);
  components.extend(runs);
}

// A few rows at a time: while runs are sought in them, the next ones come from memory.
void Identifier::Memory::find_components(const ImageView& image, const Window& window,
                                         const Band& band) {
  constexpr int kRowsAtATime = 16;
  bitmap.reshape(window.x_max - window.x_min + 1, window.y_max - window.y_min + 1);
  runs.clear();
  components.clear();
  if (band.intensity_min_dn > band.intensity_max_dn) return;
  const int height = bitmap.height_px();
  for (int y = 0; y < height; y += kRowsAtATime) {
    const int y_end = std::min(y + kRowsAtATime, height);
    fill_band_rows(image, window, band, y, y_end, bitmap);
    if (band.min_contrast_dn <= 0) take_rows(y_end < height ? y_end - 1 : height);
  }
  if (band.min_contrast_dn <= 0) return;
  background.keep_contrast(image, window, band, bitmap);
  take_rows(height);
}

IdentifyCounts Identifier::identify(const ImageView& image, const Band& band,
                                    const RegionGate& gate, Regions& regions) {
  return identify(image, {0, 0, image.width_px - 1, image.height_px - 1}, band, gate, regions);
}

IdentifyCounts Identifier::identify(const ImageView& image, const Window& window, const Band& band,
                                    const RegionGate& gate, Regions& regions) {
  regions.clear();
  if (!fits(image)) return {};
  Window searched = clipped(window, image);
  if (searched.x_min > searched.x_max || searched.y_min > searched.y_max) return {};
  auto& [bitmap, background, runs, components] = *memory_;
  memory_->find_components(image, searched, band);
  searched.y_max = searched.y_min + runs.rows_searched() - 1;

  const PixelWeights weights = band.min_contrast_dn > 0
                                   ? PixelWeights{background.excess(), 1, 0}
                                   : band_weights(inside(image, searched), band);
  IdentifyCounts counts;
  counts.runs = static_cast<std::uint32_t>(runs.size());
  counts.overflow_runs = runs.overflow();
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (!components.is_root(i)) continue;
    ++counts.components;
    if (excludes_size(gate, components[i])) {
      ++counts.rejected_size;
      continue;
    }
    count_and_keep(
        measure(image, searched, band.polarity, weights, runs, components, components[i]), gate,
        counts, regions);
  }
  return counts;
}

}  // namespace dottrack::image
