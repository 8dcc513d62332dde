#include "app/core/acquisition/pair_order.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/acquisition/room_views.h"

namespace dottrack::acquisition {
namespace {

// Some of the room's cameras, of which a few stand at another's place; some see nothing.
std::vector<core::Camera> some_cameras(std::mt19937& random) {
  const std::vector<core::Camera> room = test::room_cameras();
  std::uniform_int_distribution<std::size_t> any(0, room.size() - 1);
  std::vector<core::Camera> cameras;
  const std::size_t count = 2 + any(random) % 9;
  while (cameras.size() < count) {
    if (!cameras.empty() && any(random) < 3) {
      cameras.push_back(cameras[any(random) % cameras.size()]);
    } else {
      cameras.push_back(room[any(random)]);
    }
  }
  return cameras;
}

// Every min_views cameras that stand at two places or more have a pair at two places in the list.
TEST(PairOrder, NoCamerasAreWithoutAPair) {
  std::mt19937 random(3);
  int sets = 0;
  int shorter = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<core::Camera> cameras = some_cameras(random);
    std::vector<CameraView> views(cameras.size());
    CameraSet seeing;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      views[c].camera = &cameras[c];
      if (random() % 5 == 0) continue;
      views[c].sightings.resize(1);
      seeing.insert(c);
    }
    const auto centre = [&](std::size_t c) -> const Eigen::Vector3d& {
      return geometry::centre(cameras[c].model);
    };
    PairOrder order;
    order.start(views);
    CameraPairs pairs;
    std::array<CameraSet, kMaxCameras> done{};
    for (const int min_views : {6, 4, 3, 2}) {
      order.list(min_views, done, pairs);
      for (const CameraPair& pair : pairs) {
        EXPECT_LT(pair.a, pair.b);
        EXPECT_TRUE(seeing.contains(pair.a) && seeing.contains(pair.b));
        EXPECT_FALSE(done[pair.a].contains(pair.b)) << "listed twice";
        done[pair.a].insert(pair.b);
      }
      std::size_t listed = 0;
      for (const CameraSet& others : done) listed += static_cast<std::size_t>(others.size());
      const auto n = static_cast<std::size_t>(seeing.size());
      shorter += listed < n * (n - 1) / 2 ? 1 : 0;
      for (unsigned bits = 0; bits < (1U << cameras.size()); ++bits) {
        const CameraSet set(static_cast<std::uint16_t>(bits));
        if (set.size() != min_views || (bits & ~unsigned{seeing.bits()}) != 0) continue;
        bool two_places = false;
        bool paired = false;
        for (std::size_t a = 0; a < cameras.size(); ++a) {
          for (std::size_t b = a + 1; b < cameras.size(); ++b) {
            if (!set.contains(a) || !set.contains(b) || centre(a) == centre(b)) continue;
            two_places = true;
            paired = paired || done[a].contains(b);
          }
        }
        sets += two_places ? 1 : 0;
        EXPECT_EQ(paired, two_places) << "trial " << trial << " views " << min_views;
      }
    }
  }
  EXPECT_GT(sets, 5000);
  EXPECT_GT(shorter, 100);
}

TEST(PairOrder, FourViewsOfTwelveCamerasTakeEighteenPairs) {
  const std::vector<core::Camera> cameras = test::room_cameras();
  std::vector<CameraView> views(cameras.size());
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    views[c].camera = &cameras[c];
    views[c].sightings.resize(1);
  }
  PairOrder order;
  order.start(views);
  CameraPairs pairs;
  order.list(4, {}, pairs);
  EXPECT_LE(pairs.size(), 22U);
  order.list(3, {}, pairs);
  EXPECT_LE(pairs.size(), 36U);
  order.list(2, {}, pairs);
  EXPECT_EQ(pairs.size(), 66U);
}

}  // namespace
}  // namespace dottrack::acquisition
