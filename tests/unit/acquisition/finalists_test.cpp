#include "app/core/acquisition/finalists.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "app/core/acquisition/refine.h"
#include "tests/unit/acquisition/synthetic_views.h"

namespace dottrack::acquisition {
namespace {

using Eigen::Vector3d;

constexpr double kDiameter_m = 0.1;

TEST(Refine, AViewThatDisagreesIsDropped) {
  std::mt19937 random(6);
  const auto cameras = test::ceiling_cameras();
  std::vector<CameraView> views(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    test::see(cameras[i], {{4.0, 3.0, 0.3}}, kDiameter_m, 0.0, random, views[i]);
  }
  auto& odd = views[2].sightings[0];
  odd.line.ray.direction = (odd.line.ray.direction + 0.02 * Vector3d(0.0, 0.0, 1.0)).normalized();
  odd.pixel.x() += 12.0;
  odd.box_min_px.x() += 12.0;
  odd.box_max_px.x() += 12.0;
  PointViews seen;
  for (std::size_t c = 0; c < 5; ++c) seen.set(c, 0);
  Finalist finalist;
  ASSERT_TRUE(refine_finalist(views, seen, finalist));
  EXPECT_FALSE(finalist.cameras.contains(2));
  EXPECT_EQ(finalist.cameras.size(), 4);
  EXPECT_LT((finalist.position_m - Vector3d(4.0, 3.0, 0.3)).norm(), 1e-9);
  EXPECT_LT(finalist.worst_residual_px, 1e-6);
}

// Against a plain list: any order of adding and removing leaves the owners right.
TEST(FinalistSet, KnowsTheOwnersOfEverySighting) {
  constexpr int kSightings = 20;
  constexpr std::size_t kCameras = 3;
  std::mt19937 random(8);
  std::uniform_int_distribution<int> any(0, kSightings - 1);
  const auto some = [&] {
    Finalist finalist;
    for (std::size_t c = 0; c < kCameras; ++c) {
      if (any(random) % 4 == 0) continue;
      finalist.cameras.insert(c);
      finalist.sighting[c] = static_cast<std::uint16_t>(any(random));
    }
    return finalist;
  };
  const auto set = std::make_unique<FinalistSet>();
  set->clear();
  std::size_t owners = 0;
  for (int step = 0; step < 2000; ++step) {
    const std::size_t size = set->finalists().size();
    if (size < 10 || any(random) % 2 == 0) {
      EXPECT_TRUE(set->add(some()));
    } else {
      const auto index = static_cast<std::uint16_t>(static_cast<std::size_t>(step) % size);
      set->remove(index);
    }
    for (std::size_t c = 0; c < kCameras; ++c) {
      for (std::size_t s = 0; s < kSightings; ++s) {
        std::size_t visited = 0;
        set->visit_owners(c, s, [&](std::uint16_t index) {
          const Finalist& finalist = set->finalists()[index];
          EXPECT_EQ(set->cameras(index), finalist.cameras);
          EXPECT_TRUE(finalist.sees(c, s));
          ++visited;
          return false;
        });
        std::size_t expected = 0;
        for (const Finalist& f : set->finalists()) expected += f.sees(c, s) ? 1U : 0U;
        ASSERT_EQ(visited, expected);
        owners += expected;
      }
    }
  }
  EXPECT_GT(owners, 100000U);
}

}  // namespace
}  // namespace dottrack::acquisition
