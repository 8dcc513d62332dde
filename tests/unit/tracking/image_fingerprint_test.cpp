#include "app/core/image_fingerprint.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace dottrack::core {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 40;
constexpr int kRowStep = 16;

std::uint64_t of(const std::vector<std::uint8_t>& pixels) {
  return fingerprint({pixels.data(), kWidth, kHeight, kWidth});
}

std::vector<std::uint8_t> picture(std::uint8_t fill) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(kWidth) * kHeight, fill);
}

TEST(ImageFingerprint, TellsEveryPixelOfItsRowsApart) {
  for (const std::uint8_t fill : {std::uint8_t{0}, std::uint8_t{90}, std::uint8_t{255}}) {
    std::vector<std::uint8_t> pixels = picture(fill);
    const std::uint64_t before = of(pixels);
    for (int y = 0; y < kHeight; y += kRowStep) {
      for (int x = 0; x < kWidth; ++x) {
        std::uint8_t& pixel = pixels[static_cast<std::size_t>(y * kWidth + x)];
        pixel ^= 1U;
        EXPECT_NE(of(pixels), before) << x << ' ' << y << ' ' << int{fill};
        pixel ^= 1U;
      }
    }
    EXPECT_EQ(of(pixels), before);
  }
}

TEST(ImageFingerprint, SeesWhatHasMoved) {
  std::vector<std::uint8_t> left = picture(10);
  std::vector<std::uint8_t> right = left;
  left[8] = 200;
  right[16] = 200;
  EXPECT_NE(of(left), of(right));
}

}  // namespace
}  // namespace dottrack::core
