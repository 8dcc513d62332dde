// What the watch over the cameras makes of shifts that are known.

#include "app/core/tracking/camera_watch.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

namespace dottrack::tracking {
namespace {

using Eigen::Vector2d;

// Cameras that see so many dots each, with noise and whatever else is told.
class Cameras {
 public:
  using Shift = std::function<Vector2d(std::size_t camera, int tick)>;

  Cameras(std::size_t count, double dots, std::uint64_t seed)
      : count_(count), dots_(dots), random_(seed) {}

  std::vector<ShiftEvidence> look(int tick, const Shift& shift) {
    std::normal_distribution<double> normal(0.0, kNoise_px / std::sqrt(dots_));
    std::vector<ShiftEvidence> all(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const Vector2d noise{normal(random_), normal(random_)};
      all[i].information = dots_ * Eigen::Matrix2d::Identity();
      all[i].score = dots_ * (shift(i, tick) + noise);
    }
    return all;
  }

 private:
  static constexpr double kNoise_px = 0.08;
  std::size_t count_;
  double dots_;
  std::mt19937_64 random_;
};

// Ticks until the first camera is left out; -1: none is.
int ticks_to_notice(CameraWatch& watch, Cameras& cameras, const Cameras::Shift& shift, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) {
    watch.look(cameras.look(tick, shift));
    if (!watch.moved().empty()) return tick;
  }
  return -1;
}

constexpr double kKnock_px = 0.4;  // 0.05 degrees of a lens of 460 pixels

TEST(CameraWatch, NoticesAKnockWithinTwoSeconds) {
  int noticed = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const std::size_t knocked = seed % 6;
    Cameras cameras(6, 2.5, seed);
    CameraWatch watch(6);
    const auto shift = [&](std::size_t camera, int tick) -> Vector2d {
      const Vector2d own(0.1 * std::sin(double(camera)), 0.1 * std::cos(double(camera)));
      if (tick < 100) return own;
      // What is off pulls the others a little the other way.
      const Vector2d knock = kKnock_px * Vector2d(std::cos(double(seed)), std::sin(double(seed)));
      return own + (camera == knocked ? knock : Vector2d(-0.2 * knock));
    };
    const int tick = ticks_to_notice(watch, cameras, shift, 300);
    ASSERT_GE(tick, 100);
    EXPECT_LT(tick, 160);
    EXPECT_TRUE(watch.moved().contains(knocked)) << seed;
    EXPECT_EQ(watch.moved().size(), 1);
    ++noticed;
  }
  EXPECT_EQ(noticed, 50);
}

TEST(CameraWatch, IsNotMisledByModelsThatAreOffFromPlaceToPlace) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Cameras cameras(6, 2.0, seed);
    CameraWatch watch(6);
    const auto shift = [&](std::size_t camera, int tick) -> Vector2d {
      const double way = 0.004 * tick * (1.0 + 0.3 * double(camera)) + double(seed);
      return {0.3 * std::sin(way), 0.3 * std::cos(1.3 * way)};
    };
    EXPECT_EQ(ticks_to_notice(watch, cameras, shift, 2000), -1) << seed;
    EXPECT_FALSE(watch.rig_disagrees());
  }
}

TEST(CameraWatch, ForgivesWhatPasses) {
  Cameras cameras(6, 3.0, 1);
  CameraWatch watch(6);
  const auto shadow = [](std::size_t camera, int tick) -> Vector2d {
    return {camera == 1 && tick % 100 < 15 ? 0.6 : 0.0, 0.0};
  };
  EXPECT_EQ(ticks_to_notice(watch, cameras, shadow, 2000), -1);
}

TEST(CameraWatch, NoticesACameraThatWasMovedWhileNobodyLooked) {
  Cameras cameras(6, 3.0, 1);
  CameraWatch watch(6);
  const auto off = [](std::size_t camera, int) -> Vector2d {
    return {camera == 4 ? 1.0 : 0.0, 0.0};
  };
  const int tick = ticks_to_notice(watch, cameras, off, 200);
  EXPECT_GE(tick, 0);
  EXPECT_LT(tick, 60);
  EXPECT_TRUE(watch.moved().contains(4));
}

TEST(CameraWatch, NeverLeavesFewerThanThree) {
  Cameras cameras(5, 3.0, 1);
  CameraWatch watch(5);
  const auto one_by_one = [](std::size_t camera, int tick) -> Vector2d {
    return {tick > 100 * int(camera + 1) ? 0.8 + 0.3 * double(camera) : 0.0, 0.0};
  };
  for (int tick = 0; tick < 1000; ++tick) {
    watch.look(cameras.look(tick, one_by_one));
    ASSERT_LE(watch.moved().size(), 2);
  }
  EXPECT_EQ(watch.moved().size(), 2);
  EXPECT_TRUE(watch.rig_disagrees());
  watch.readmit();
  EXPECT_TRUE(watch.moved().empty());
  EXPECT_FALSE(watch.rig_disagrees());
}

TEST(CameraWatch, SaysThatNothingFitsWhenAllAreOff) {
  Cameras cameras(6, 3.0, 1);
  CameraWatch watch(6);
  const auto all = [](std::size_t camera, int) -> Vector2d {
    const double way = double(camera);
    return {1.5 * std::cos(way), 1.5 * std::sin(way)};
  };
  EXPECT_EQ(ticks_to_notice(watch, cameras, all, 500), -1);
  EXPECT_TRUE(watch.rig_disagrees());
}

TEST(CameraWatch, StartsAnewAfterAnInterruption) {
  Cameras cameras(6, 3.0, 1);
  CameraWatch watch(6);
  const auto shift = [](std::size_t camera, int tick) -> Vector2d {
    return {camera == 2 && tick >= 50 ? 0.4 : 0.0, 0.0};
  };
  for (int tick = 0; tick < 200; ++tick) {
    if (tick == 50) watch.interrupt();
    watch.look(cameras.look(tick, shift));
  }
  EXPECT_TRUE(watch.moved().empty());
  EXPECT_NEAR(watch.shift_px(2).x(), 0.4, 0.1);
}

TEST(CameraWatch, KnowsNothingOfCamerasThatSeeTooLittle) {
  CameraWatch watch(4);
  std::vector<ShiftEvidence> nothing(4);
  for (int tick = 0; tick < 200; ++tick) {
    watch.look(nothing);
    watch.look({});
  }
  EXPECT_TRUE(watch.moved().empty());
  EXPECT_TRUE(watch.shift_px(0).isZero(0.0));
}

}  // namespace
}  // namespace dottrack::tracking
