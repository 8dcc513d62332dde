#include "tests/bench/opencv_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/bench/blob_scene.h"
#include "tests/bench/opencv_identify.h"

namespace dottrack::bench {
namespace {

// In-band pixels white, all others black: so all pixels of a region weigh the same.
std::vector<std::uint8_t> black_and_white(const ImageView& image) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      pixels.push_back(image.row(y)[x] >= kBandMin ? 255 : 0);
    }
  }
  return pixels;
}

bool passes(const image::RegionGate& gate, const Blob& blob) {
  const double fill = blob.area_px / (std::numbers::pi * blob.semi_major_px * blob.semi_minor_px);
  return blob.area_px >= gate.min_area_px && blob.semi_major_px >= gate.semi_major_min_px &&
         blob.semi_major_px <= gate.semi_major_max_px &&
         blob.semi_minor_px >= gate.min_axis_ratio * blob.semi_major_px && fill >= gate.min_fill;
}

bool same(const Blob& blob, const image::Region& region) {
  constexpr double kTolerance_px = 1e-6;
  const auto near = [](double a, double b) { return std::abs(a - b) < kTolerance_px; };
  return blob.area_px == region.area_px && blob.x_min == region.x_min &&
         blob.y_min == region.y_min && blob.width_px == region.width_px() &&
         blob.height_px == region.height_px() && near(blob.x, region.centroid_px.x()) &&
         near(blob.y, region.centroid_px.y()) && near(blob.semi_major_px, region.semi_major_px) &&
         near(blob.semi_minor_px, region.semi_minor_px);
}

// In whatever order.
bool same_sets(const std::vector<Blob>& blobs, const image::Regions& regions) {
  return blobs.size() == regions.size() &&
         std::all_of(blobs.begin(), blobs.end(), [&regions](const Blob& blob) {
           return std::any_of(regions.begin(), regions.end(),
                              [&blob](const image::Region& region) { return same(blob, region); });
         });
}

}  // namespace

std::string opencv_disagrees(const ImageView& image, const image::RegionGate& gate) {
  const std::vector<std::uint8_t> pixels = black_and_white(image);
  const ImageView view{pixels.data(), image.width_px, image.height_px, image.width_px};
  const auto identifier = std::make_unique<image::Identifier>();
  const auto regions = std::make_unique<image::Regions>();
  std::vector<Blob> blobs = opencv_blobs(view);
  const image::Band band{.intensity_min_dn = kBandMin};
  const std::uint32_t components = identifier->identify(view, band, {}, *regions).components;
  if (components != blobs.size()) return "OpenCV counts other components";
  if (!same_sets(blobs, *regions)) return "OpenCV measures other components";
  std::erase_if(blobs, [&gate](const Blob& blob) { return !passes(gate, blob); });
  identifier->identify(view, band, gate, *regions);
  if (blobs.size() < 90 || !same_sets(blobs, *regions)) return "OpenCV passes other regions";
  return {};
}

}  // namespace dottrack::bench
