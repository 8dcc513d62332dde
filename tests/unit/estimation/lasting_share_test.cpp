// How much of the views' errors is found to stay the same.

#include "app/core/estimation/lasting_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace dottrack::estimation {
namespace {

constexpr std::size_t kCameras = 8;
constexpr std::size_t kDots = 5;

// Views whose residuals have unit variance, a part of which stays.
class Views {
 public:
  explicit Views(double lasting) : lasting_(lasting), stays_(some()) {}

  std::vector<ViewResidual> next() {
    std::vector<ViewResidual> views = some();
    for (std::size_t i = 0; i < views.size(); ++i) {
      views[i].of = std::sqrt(lasting_) * stays_[i].of + std::sqrt(1.0 - lasting_) * views[i].of;
    }
    return views;
  }

 private:
  std::vector<ViewResidual> some() {
    std::vector<ViewResidual> views;
    for (std::size_t camera = 0; camera < kCameras; ++camera) {
      for (std::size_t dot = 0; dot < kDots; ++dot) {
        views.push_back({camera, dot, Eigen::Vector2d(normal_(random_), normal_(random_))});
      }
    }
    return views;
  }

  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
  double lasting_;
  std::vector<ViewResidual> stays_;
};

TEST(LastingShareTest, IsNothingBeforeTwoTicks) {
  LastingShare share;
  EXPECT_EQ(share.value(), 0.0);
  share.take_in(Views(1.0).next());
  EXPECT_EQ(share.value(), 0.0);
}

TEST(LastingShareTest, IsWhatStays) {
  constexpr int kTicks = 2000;
  for (const double lasting : {0.0, 0.3, 0.7, 0.9}) {
    Views views(lasting);
    LastingShare share;
    double sum = 0.0;
    for (int tick = 0; tick < kTicks; ++tick) {
      share.take_in(views.next());
      sum += share.value();
    }
    EXPECT_NEAR(sum / kTicks, lasting, 0.05 * lasting + 0.005) << lasting;
  }
}

TEST(LastingShareTest, IsNeverAll) {
  Views views(1.0);
  LastingShare share;
  for (int tick = 0; tick < 10; ++tick) share.take_in(views.next());
  EXPECT_GT(share.value(), 0.94);
  EXPECT_LE(share.value(), 0.95);
}

TEST(LastingShareTest, IsNeverNegative) {
  Views views(1.0);
  LastingShare share;
  for (int tick = 0; tick < 10; ++tick) {
    std::vector<ViewResidual> now = views.next();
    for (ViewResidual& view : now) view.of *= tick % 2 == 0 ? 1.0 : -1.0;
    share.take_in(now);
    EXPECT_EQ(share.value(), 0.0);
  }
}

// A vehicle that drives off, or another one.
TEST(LastingShareTest, IsForgottenInSomeTicks) {
  Views stay(1.0);
  Views change(0.0);
  LastingShare share;
  for (int tick = 0; tick < 20; ++tick) share.take_in(stay.next());
  for (int tick = 0; tick < 8; ++tick) share.take_in(change.next());
  EXPECT_LT(share.value(), 0.2);
}

// A camera that did not deliver has no last residuals; the others say it.
TEST(LastingShareTest, IsOfTheViewsThatWereSeenTwice) {
  Views stay(1.0);
  LastingShare share;
  const std::vector<ViewResidual> all = stay.next();
  const std::vector<ViewResidual> half(all.begin(), all.begin() + kCameras / 2 * kDots);
  std::vector<ViewResidual> others_turned = all;
  for (std::size_t i = half.size(); i < all.size(); ++i) others_turned[i].of *= -1.0;
  share.take_in(all);
  share.take_in(half);
  const double of_half = share.value();
  EXPECT_GT(of_half, 0.4);
  share.take_in(others_turned);
  EXPECT_GE(share.value(), of_half);
}

}  // namespace
}  // namespace dottrack::estimation
