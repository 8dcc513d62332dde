// Small components against a plain flood fill: each is whole, each row of it one run, none is
// missed, and all else is left.

#include "app/core/image/small_components.h"

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <random>
#include <vector>

namespace dottrack::image::test {
namespace {

struct Pixels {
  int width_px;
  int height_px;
  std::vector<char> in_band;

  bool at(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_px && y < height_px && in_band[index(x, y)] != 0;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
           static_cast<std::size_t>(x);
  }
};

struct Plain {
  PixelKey first;
  int x_min, x_max, y_min, y_max;
  int area_px = 0;
  int runs = 0;
  std::uint64_t bits = 0;

  int width_px() const { return x_max - x_min + 1; }
  int height_px() const { return y_max - y_min + 1; }
  bool is_small() const {
    return area_px > 1 && width_px() <= SmallComponent::kSide_px &&
           height_px() <= SmallComponent::kSide_px && runs == height_px();
  }
};

Plain flood(Pixels& pixels, const Pixels& all, int x, int y) {
  Plain plain{y * kRowStep + x, x, x, y, y};
  std::vector<std::pair<int, int>> members;
  std::vector<std::pair<int, int>> open{{x, y}};
  pixels.in_band[pixels.index(x, y)] = 0;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    members.emplace_back(i, j);
    plain.x_min = std::min(plain.x_min, i);
    plain.x_max = std::max(plain.x_max, i);
    plain.y_min = std::min(plain.y_min, j);
    plain.y_max = std::max(plain.y_max, j);
    if (!all.at(i - 1, j)) ++plain.runs;
    for (const auto& [u, v] : {std::pair(i - 1, j), {i + 1, j}, {i, j - 1}, {i, j + 1}}) {
      if (!pixels.at(u, v)) continue;
      pixels.in_band[pixels.index(u, v)] = 0;
      open.emplace_back(u, v);
    }
  }
  plain.area_px = static_cast<int>(members.size());
  if (plain.is_small()) {
    for (const auto& [i, j] : members) {
      plain.bits |= std::uint64_t{1}
                    << static_cast<unsigned>(8 * (j - plain.y_min) + i - plain.x_min);
    }
  }
  return plain;
}

std::vector<Plain> plain_components(const Pixels& all) {
  Pixels rest = all;
  std::vector<Plain> found;
  for (int y = 0; y < all.height_px; ++y) {
    for (int x = 0; x < all.width_px; ++x) {
      if (rest.at(x, y)) found.push_back(flood(rest, all, x, y));
    }
  }
  return found;
}

void set_row(const Pixels& pixels, int y, Bitmap& bitmap) {
  std::uint64_t* const words = bitmap.row(y);
  const int count = bitmap.words_per_row();
  std::fill_n(words, count + Bitmap::kGroupWords, 0U);
  for (int x = 0; x < pixels.width_px; ++x) {
    if (pixels.at(x, y)) words[x / 64] |= std::uint64_t{1} << static_cast<unsigned>(x % 64);
  }
  PixelKey* end = bitmap.occupied_end();
  for (int w = 0; w < count; w += Bitmap::kGroupWords) {
    if ((words[w] | words[w + 1] | words[w + 2] | words[w + 3]) != 0) {
      *end++ = y * kRowStep + 64 * w;
    }
  }
  bitmap.set_occupied_end(y, end);
}

class SmallComponentsTest : public testing::Test {
 protected:
  // Rows come `rows` at a time.
  void take(const Pixels& pixels, int rows) {
    const std::vector<std::uint8_t> grey(1);
    const ImageView view{grey.data(), 1, 1, 1};
    bitmap_->reshape(pixels.width_px, pixels.height_px);
    small_->clear();
    for (int y = 0; y < pixels.height_px; y += rows) {
      const int y_end = std::min(y + rows, pixels.height_px);
      for (int j = y; j < y_end; ++j) set_row(pixels, j, *bitmap_);
      const int known = y_end == pixels.height_px ? y_end : y_end - SmallComponent::kSide_px;
      small_->take(*bitmap_, std::max(known, 0), LinesAhead(view, 0, 1));
    }
    small_->finish(*bitmap_);
  }

  void expect_those_of(const Pixels& pixels) {
    std::size_t next = 0;
    std::vector<PixelKey> groups_left;
    for (const Plain& plain : plain_components(pixels)) {
      const bool cleared = !at(plain.first);
      EXPECT_EQ(cleared, plain.is_small());
      if (!plain.is_small()) continue;
      ASSERT_LT(next, small_->size());
      const SmallComponent& found = (*small_)[next++];
      EXPECT_EQ(found.first, plain.first);
      EXPECT_EQ(found.bits, plain.bits);
      EXPECT_EQ(found.x_min, plain.x_min);
      EXPECT_EQ(found.y_min, plain.y_min);
      EXPECT_EQ(found.width_px, plain.width_px());
      EXPECT_EQ(found.height_px, plain.height_px());
    }
    EXPECT_EQ(next, small_->size());
    compared_ += next;
    expect_groups_left(pixels);
  }

  // Every group with a pixel of a component that is not small is listed, and no group without a
  // pixel that has a neighbour.
  void expect_groups_left(const Pixels& pixels) {
    std::size_t next = 0;
    const auto left = small_->groups_left();
    for (const PixelKey group : bitmap_->occupied()) {
      bool some = false;
      for (int i = 0; i < 64 * Bitmap::kGroupWords; ++i) {
        const int x = column(group) + i;
        const int y = row(group);
        const bool alone = !pixels.at(x - 1, y) && !pixels.at(x + 1, y) && !pixels.at(x, y - 1) &&
                           !pixels.at(x, y + 1);
        some |= pixels.at(x, y) && at(group + i) && !alone;
      }
      if (!some) continue;
      ASSERT_LT(next, left.size());
      EXPECT_EQ(left[next++], group);
    }
    EXPECT_EQ(next, left.size());
  }

  bool at(PixelKey key) const { return bitmap_->at(column(key), row(key)); }

  std::unique_ptr<Bitmap> bitmap_ = std::make_unique<Bitmap>();
  std::unique_ptr<SmallComponents> small_ = std::make_unique<SmallComponents>();
  std::size_t compared_ = 0;
};

Pixels noise(int width_px, int height_px, double density, std::mt19937& random) {
  Pixels pixels{width_px, height_px, {}};
  const auto least = static_cast<std::mt19937::result_type>(density * 4294967295.0);
  pixels.in_band.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (char& pixel : pixels.in_band) pixel = random() < least ? 1 : 0;
  return pixels;
}

TEST_F(SmallComponentsTest, AreThoseOfAFloodFillInNoiseOfAnyDensity) {
  std::mt19937 random(1);
  for (const double density : {0.02, 0.1, 0.2, 0.35, 0.5, 0.7}) {
    for (const int width : {8, 63, 64, 65, 200, 257, 300}) {
      const Pixels pixels = noise(width, 90, density, random);
      take(pixels, 16);
      expect_those_of(pixels);
    }
  }
  EXPECT_GT(compared_, 11000U);
}

TEST_F(SmallComponentsTest, AreFoundHoweverManyRowsComeAtATime) {
  std::mt19937 random(2);
  for (const int rows : {1, 7, 8, 9, 40, 1000}) {
    const Pixels pixels = noise(130, 101, 0.3, random);
    take(pixels, rows);
    expect_those_of(pixels);
  }
  EXPECT_GT(compared_, 2000U);
}

TEST_F(SmallComponentsTest, RectanglesOfAllSizesAtAllPlacesAcrossWords) {
  for (int x = 50; x < 70; ++x) {
    for (int width = 1; width <= 10; ++width) {
      for (int height = 1; height <= 10; ++height) {
        Pixels pixels{140, 30, std::vector<char>(140 * 30)};
        for (int j = 3; j < 3 + height; ++j) {
          for (int i = x; i < x + width; ++i) pixels.in_band[pixels.index(i, j)] = 1;
        }
        take(pixels, 16);
        expect_those_of(pixels);
      }
    }
  }
  EXPECT_EQ(compared_, 20U * (8U * 8U - 1U));
}

TEST_F(SmallComponentsTest, AComponentWithAGapInARowIsLeft) {
  for (const bool open_above : {false, true}) {
    Pixels pixels{20, 20, std::vector<char>(400)};
    for (int i = 5; i < 10; ++i) pixels.in_band[pixels.index(i, open_above ? 8 : 4)] = 1;
    for (int j = 4; j < 9; ++j) pixels.in_band[pixels.index(5, j)] = 1;
    for (int j = 4; j < 9; ++j) pixels.in_band[pixels.index(9, j)] = 1;
    take(pixels, 16);
    EXPECT_EQ(small_->size(), 0U);
    expect_those_of(pixels);
  }
}

TEST_F(SmallComponentsTest, WhatExceedsTheCapacityIsLeft) {
  Pixels pixels{2000, 300, std::vector<char>(2000 * 300)};
  std::size_t count = 0;
  for (int y = 0; y < 300; y += 2) {
    for (int x = 0; x + 1 < 2000; x += 3, ++count) {
      pixels.in_band[pixels.index(x, y)] = 1;
      pixels.in_band[pixels.index(x + 1, y)] = 1;
    }
  }
  ASSERT_GT(count, SmallComponents::kCapacity + 1000);
  take(pixels, 16);
  EXPECT_GE(small_->size(), SmallComponents::kCapacity);
  std::size_t left = 0;
  for (int y = 0; y < 300; y += 2) {
    for (int x = 0; x + 1 < 2000; x += 3) left += bitmap_->at(x, y) ? 1U : 0U;
  }
  EXPECT_EQ(small_->size() + left, count);
}

}  // namespace
}  // namespace dottrack::image::test
