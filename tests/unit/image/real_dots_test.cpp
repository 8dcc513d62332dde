// Dots in photographs of a real plate: faint, among scratches, tape edges and noise.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "app/core/image/identify.h"
#include "drivers/recorded/pgm_reader.h"
#include "tests/support/shared_data.h"

namespace dottrack::image::test {
namespace {

struct Dot {
  int camera;
  Eigen::Vector2d pixel;
};

// cam,dot,x,y with a line of headings.
std::vector<Dot> read_dots(const std::filesystem::path& path) {
  std::vector<Dot> dots;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    Dot dot{};
    int number = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%lf,%lf", &dot.camera, &number, &dot.pixel.x(),
                    &dot.pixel.y()) == 4) {
      dots.push_back(dot);
    }
  }
  return dots;
}

constexpr int kWidth = 1280;
constexpr int kHeight = 1024;
constexpr Band kBand{.min_contrast_dn = 8, .background_px = 21};
constexpr RegionGate kGate{
    .semi_major_min_px = 2.2, .semi_major_max_px = 6.0, .min_axis_ratio = 0.4, .min_fill = 0.8};

class RealDots : public testing::TestWithParam<const char*> {
 protected:
  void identify(const std::filesystem::path& folder, int camera) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kWidth * kHeight));
    const auto path = folder / "frames" / ("cam" + std::to_string(camera)) / "000000.pgm";
    ASSERT_TRUE(drivers::read_pgm(path, kWidth, kHeight, pixels)) << path;
    counts_ =
        identifier_.identify({pixels.data(), kWidth, kHeight, kWidth}, kBand, kGate, *regions_);
  }

  double distance_to_nearest(const Eigen::Vector2d& pixel) const {
    double nearest = 1e9;
    for (const Region& region : *regions_) {
      nearest = std::min(nearest, (region.centroid_px - pixel).norm());
    }
    return nearest;
  }

  Identifier identifier_;
  IdentifyCounts counts_;
  std::unique_ptr<Regions> regions_ = std::make_unique<Regions>();
};

TEST_P(RealDots, EveryDotIsARegion) {
  const auto data = dottrack::test::shared_data();
  if (!data) GTEST_SKIP() << "shared data absent: real_target";
  const auto folder = *data / "real_target" / GetParam();
  const std::vector<Dot> dots = read_dots(folder / "true_dots.csv");
  ASSERT_GE(dots.size(), 15U);
  double sum_squares = 0.0;
  for (int camera = 1; camera <= 3; ++camera) {
    identify(folder, camera);
    EXPECT_EQ(counts_.overflow_runs, 0U);
    EXPECT_LE(regions_->size(), 150U);  // of some 3000 components of four pixels or more
    for (const Dot& dot : dots) {
      if (dot.camera != camera) continue;
      const double distance = distance_to_nearest(dot.pixel);
      EXPECT_LT(distance, 0.6) << "camera " << camera << " at " << dot.pixel.transpose();
      sum_squares += distance * distance;
    }
  }
  EXPECT_LT(std::sqrt(sum_squares / static_cast<double>(dots.size())), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Plates, RealDots, testing::Values("myptv_n5", "myptv_n8"));

}  // namespace
}  // namespace dottrack::image::test
