#include "app/workstation/calibrate/labelling/blobs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "app/core/image/dot_centre.h"
#include "app/core/image/dot_fit.h"
#include "app/core/image/identify.h"
#include "app/workstation/calibrate/labelling/disc_fit.h"

namespace dottrack::calibrate {
namespace {

constexpr int kSmallBackground_px = 21;
constexpr double kSmallDot_px = 12.0;   // that the small background suits
constexpr double kDotsPerSurround = 4;  // width of a background to that of its dots
constexpr int kTile_px = 256;
constexpr double kUnsure_px = 0.3;  // sigma of a centre that its rim does not tell

struct Scale {
  int background_px;
  double min_px;
  double max_px;
};

std::vector<Scale> scales_of(const BlobOptions& options) {
  if (options.background_px) {
    return {{*options.background_px, options.min_dot_px, options.max_dot_px}};
  }
  std::vector<Scale> scales;
  if (options.min_dot_px < kSmallDot_px) {
    scales.push_back(
        {kSmallBackground_px, options.min_dot_px, std::min(options.max_dot_px, kSmallDot_px)});
  }
  if (options.max_dot_px > kSmallDot_px) {
    const int wide = static_cast<int>(kDotsPerSurround * options.max_dot_px) | 1;
    scales.push_back({std::min(wide, 255), std::max(0.7 * kSmallDot_px, options.min_dot_px),
                      options.max_dot_px});
  }
  return scales;
}

image::RegionGate gate_of(const Scale& scale) {
  return {.semi_major_min_px = 0.5 * scale.min_px,
          .semi_major_max_px = 0.5 * scale.max_px,
          .min_axis_ratio = 0.3,
          .min_fill = 0.75,
          .min_core_contrast_dn = 0.0,
          .max_box_misfit_px = 1.5,
          .max_box_misfit_part = 0.2,
          .min_area_px = 5};
}

// Of the grey values: from the differences of neighbours that are not on an edge.
double noise_dn(const ImageView& image) {
  std::array<std::size_t, 256> counts{};
  std::size_t total = 0;
  for (int y = 0; y + 1 < image.height_px; y += 3) {
    const std::uint8_t* const row = image.row(y);
    const std::uint8_t* const below = image.row(y + 1);
    for (int x = 0; x + 1 < image.width_px; x += 2) {
      const int mixed = row[x] - row[x + 1] - below[x] + below[x + 1];
      ++counts[static_cast<std::size_t>(std::min(std::abs(mixed), 255))];
      ++total;
    }
  }
  std::size_t seen = 0;
  for (std::size_t dn = 0; dn < counts.size(); ++dn) {
    if (counts[dn] > 0 && 2 * (seen + counts[dn]) >= total) {
      const double share = (0.5 * static_cast<double>(total) - static_cast<double>(seen)) /
                           static_cast<double>(counts[dn]);
      const double median = dn == 0 ? share * 0.5 : static_cast<double>(dn) - 0.5 + share;
      return std::max(median / (0.6745 * 2.0), 0.3);
    }
    seen += counts[dn];
  }
  return 1.0;
}

// Twice the bound on what can be known of the centre of a disc of this size and contrast.
double centre_sigma_px(double noise, double contrast_dn, double diameter_px) {
  constexpr double kFloor_px = 0.02;
  constexpr double kBlur_px = 0.85;
  const double bound = noise / std::max(contrast_dn, 1.0) *
                       std::sqrt(4.0 * std::sqrt(std::numbers::pi) * kBlur_px /
                                 (std::numbers::pi * std::max(diameter_px, 2.0)));
  return std::max(2.0 * bound, kFloor_px);
}

constexpr double kLeastSigma_px = 0.02;

class Finder {
 public:
  Finder(const ImageView& image, const BlobOptions& options)
      : image_(image), options_(options), noise_dn_(noise_dn(image)) {}

  void search(const Scale& scale) {
    const int margin = static_cast<int>(scale.max_px) + scale.background_px;
    for (int y = 0; y < image_.height_px; y += kTile_px) {
      for (int x = 0; x < image_.width_px; x += kTile_px) search_tile(scale, x, y, margin);
    }
  }

  std::vector<Blob> take() { return std::move(blobs_); }

 private:
  void search_tile(const Scale& scale, int x, int y, int margin) {
    const image::Band band{.min_contrast_dn = options_.min_contrast_dn,
                           .background_px = scale.background_px,
                           .polarity = options_.polarity};
    const int x_first = std::max(x - margin, 0);
    const int y_first = std::max(y - margin, 0);
    const ImageView crop{
        image_.row(y_first) + x_first, std::min(x + kTile_px + margin, image_.width_px) - x_first,
        std::min(y + kTile_px + margin, image_.height_px) - y_first, image_.stride_bytes};
    identifier_.identify(crop, band, gate_of(scale), *regions_);
    for (image::Region region : *regions_) {
      region.centroid_px += Eigen::Vector2d(x_first, y_first);
      region.x_min = static_cast<std::int16_t>(region.x_min + x_first);
      region.x_max = static_cast<std::int16_t>(region.x_max + x_first);
      region.y_min = static_cast<std::int16_t>(region.y_min + y_first);
      region.y_max = static_cast<std::int16_t>(region.y_max + y_first);
      const bool here = region.centroid_px.x() >= x - 0.5 && region.centroid_px.y() >= y - 0.5 &&
                        region.centroid_px.x() < x + kTile_px - 0.5 &&
                        region.centroid_px.y() < y + kTile_px - 0.5;
      if (here && !region.touches_border) add(region);
    }
  }

  // A dot that both backgrounds show is the larger of the two: what cuts it short is too narrow.
  void add(const image::Region& region) {
    const Blob blob = measured(region);
    for (Blob& other : blobs_) {
      const double reach = std::max(other.semi_major_px, blob.semi_major_px);
      if ((other.pixel - blob.pixel).squaredNorm() > reach * reach) continue;
      if (blob.semi_minor_px > 1.15 * other.semi_minor_px) other = blob;
      return;
    }
    blobs_.push_back(blob);
  }

  Blob measured(const image::Region& region) const {
    Blob blob;
    blob.pixel = image::dot_centre(image_, region);
    blob.semi_major_px = region.semi_major_px;
    blob.semi_minor_px = region.semi_minor_px;
    blob.angle_rad = region.angle_rad;
    blob.contrast_dn = region.core_contrast_dn + options_.min_contrast_dn;
    blob.sigma_px =
        centre_sigma_px(noise_dn_, blob.contrast_dn, region.semi_major_px + region.semi_minor_px);
    if (!take_outline(region, blob)) refine(blob);
    return blob;
  }

  // By the outline that tracking fits, if the dot and its surround are as even as that takes.
  bool take_outline(const image::Region& region, Blob& blob) const {
    const image::DotFit fit = image::fit_dot(image_, region, nullptr);
    if (fit.flaw != image::DotFlaw::none) return false;
    blob.pixel = fit.centre_px;
    blob.semi_major_px = fit.semi_major_px;
    blob.semi_minor_px = fit.semi_minor_px;
    blob.angle_rad = fit.angle_rad;
    blob.contrast_dn = std::abs(fit.contrast_dn);
    blob.sigma_px = std::max(std::sqrt(0.5 * fit.covariance_px2.trace()), kLeastSigma_px);
    return true;
  }

  void refine(Blob& blob) const {
    const double towards = options_.polarity == core::Polarity::bright ? 1.0 : -1.0;
    const auto disc = fit_disc(image_, {blob.pixel, blob.semi_major_px, blob.semi_minor_px,
                                        blob.angle_rad, towards * blob.contrast_dn, 0.0});
    if (!disc) {
      blob.sigma_px = std::max(blob.sigma_px, kUnsure_px);
      return;
    }
    blob.pixel = disc->centre;
    blob.semi_major_px = disc->semi_major_px;
    blob.semi_minor_px = disc->semi_minor_px;
    blob.angle_rad = disc->angle_rad;
    blob.contrast_dn = std::abs(disc->contrast_dn);
    blob.sigma_px = std::max(disc->sigma_px, kLeastSigma_px);
  }

  const ImageView& image_;
  const BlobOptions& options_;
  double noise_dn_;
  image::Identifier identifier_;
  std::unique_ptr<image::Regions> regions_ = std::make_unique<image::Regions>();
  std::vector<Blob> blobs_;
};

}  // namespace

std::vector<Blob> find_blobs(const ImageView& image, const BlobOptions& options) {
  Finder finder(image, options);
  for (const Scale& scale : scales_of(options)) finder.search(scale);
  return finder.take();
}

}  // namespace dottrack::calibrate
