#include "tests/board/harness/lighting.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dottrack::board {
namespace {

double mean_of(const host_sim::GreyImage& image) {
  const auto& pixels = image.pixels();
  if (pixels.empty()) return 0.0;
  return static_cast<double>(std::accumulate(pixels.begin(), pixels.end(), std::uint64_t{0})) /
         static_cast<double>(pixels.size());
}

}  // namespace

host_sim::PictureSource Lighting::light(host_sim::PictureSource pictures) {
  return [this, pictures = std::move(pictures)](std::span<const host_sim::Exposure> exposures,
                                                std::vector<host_sim::GreyImage>& images) {
    std::vector<host_sim::Exposure> lit(exposures.begin(), exposures.end());
    for (host_sim::Exposure& exposure : lit) exposure.opening *= part_;
    pictures(lit, images);
    note(images);
  };
}

void Lighting::note(const std::vector<host_sim::GreyImage>& images) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < std::min(images.size(), means_dn_.size()); ++i) {
    means_dn_[i] = mean_of(images[i]);
  }
}

double Lighting::mean_dn(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return means_dn_.at(camera);
}

}  // namespace dottrack::board
