// A whole scene through all of its cameras, on several threads.

#include "host_sim/scenarios/scene_renderer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <deque>
#include <stdexcept>

#include "host_sim/scenarios/body_scenes.h"
#include "host_sim/scenarios/parallel.h"
#include "host_sim/scenarios/placements.h"
#include "host_sim/scenarios/scenario_file.h"

namespace dottrack::host_sim {
namespace {

Scene small_scene() {
  const auto scene = parse_scenario(
      "[scenario]\nname = \"small\"\nticks = 3\n[motion]\nkind = \"drive\"\n"
      "way_points = [[-1, 0], [1, 0]]\nclosed = false\n[[person]]\nway_points = [[0, 2]]\n"
      "[hall]\nrocks = 10\nlook_alikes = 4\nlander = false\nfurniture = false\n"
      "[cameras]\ncount = 3\nwidth_px = 64\nheight_px = 48\n",
      "small.toml");
  if (!scene) throw std::runtime_error(scene.error().message);
  return *scene;
}

std::vector<Exposure> exposures_at(double time_s, std::uint64_t tick) {
  std::vector<Exposure> exposures(3);
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    exposures[i].middle_s = time_s;
    exposures[i].noise = {1, i, tick};
  }
  return exposures;
}

bool same(const std::vector<GreyImage>& a, const std::vector<GreyImage>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const GreyImage& x, const GreyImage& y) { return x.pixels() == y.pixels(); });
}

TEST(SceneRendererTest, TheBytesDoNotDependOnTheNumberOfThreadsNorOnWhatWasRenderedBefore) {
  const Scene scene = small_scene();
  SceneRenderer one(scene, 1);
  SceneRenderer three(scene, 3);
  std::vector<GreyImage> a;
  std::vector<GreyImage> b;
  one.render(exposures_at(0.0, 0), a);
  one.render(exposures_at(2.0, 20), a);
  three.render(exposures_at(2.0, 20), b);
  ASSERT_EQ(a.size(), 3U);
  EXPECT_EQ(a[0].width_px(), 64);
  EXPECT_TRUE(same(a, b));
  three.render(exposures_at(2.1, 20), b);
  EXPECT_FALSE(same(a, b)) << "the rover has moved";
}

TEST(SceneRendererTest, OtherBodiesAndAnotherLightLeaveTheSceneAsItIs) {
  const Scene scene = small_scene();
  SceneRenderer renderer(scene, 2);
  std::vector<GreyImage> first;
  std::vector<GreyImage> bare;
  std::vector<GreyImage> again;
  renderer.render(exposures_at(0.0, 0), first);
  renderer.render(exposures_at(0.0, 0), {}, scene.world.light, bare);
  EXPECT_FALSE(same(first, bare));
  LightPlan dark;
  for (const char* group : {"fluorescent", "window", "sun"})
    dark.changes.push_back({group, 0, 0, 0});
  renderer.render(exposures_at(0.0, 0), renderer.bodies(), dark, again);
  for (const GreyImage& image : again) {
    EXPECT_LT(*std::max_element(image.pixels().begin(), image.pixels().end()), 12);
  }
  renderer.render(exposures_at(0.0, 0), again);
  EXPECT_TRUE(same(first, again));
}

// Random bodies in random light.
class Shots : public testing::Test {
 protected:
  static constexpr std::uint64_t kShots = 4;

  void SetUp() override {
    for (std::uint64_t i = 0; i < kShots; ++i) {
      placements_.push_back(random_placement(scene_, hall_.scene, 3, i));
    }
    for (const Placement& placement : placements_) bodies_.emplace_back(placement.bodies);
  }

  SceneRenderer::Shot shot(std::uint64_t i) const {
    SceneRenderer::Shot shot;
    shot.exposures = exposures_at(0.0, i);
    for (Exposure& exposure : shot.exposures) exposure.opening = placements_[i].opening;
    shot.bodies = bodies_[i].moving();
    shot.light = placements_[i].light;
    return shot;
  }

  // Through one batch, read out.
  static std::vector<std::vector<GreyImage>> pictures(SceneRenderer& renderer,
                                                      std::vector<SceneRenderer::Shot> shots,
                                                      Detail detail) {
    renderer.collect(shots, detail);
    std::vector<std::vector<GreyImage>> all;
    for (const SceneRenderer::Shot& shot : shots) {
      std::vector<GreyImage>& images = all.emplace_back(shot.exposures.size());
      for (std::size_t i = 0; i < images.size(); ++i) {
        renderer.read(shot, i, shot.exposures[i].noise, images[i]);
      }
    }
    return all;
  }

  Scene scene_ = small_scene();
  Hall hall_{scene_.world.hall, scene_.world.lamps};
  std::vector<Placement> placements_;
  std::deque<BodyScenes> bodies_;
};

TEST_F(Shots, InABatchAreTheBytesOfPicturesOneByOne) {
  SceneRenderer batch(scene_, 2);
  std::vector<SceneRenderer::Shot> shots;
  for (std::uint64_t i = 0; i < kShots; ++i) shots.push_back(shot(i));
  const auto together = pictures(batch, std::move(shots), Detail::full);
  SceneRenderer singly(scene_, 1);
  for (std::uint64_t i = kShots; i-- > 0;) {
    std::vector<GreyImage> images;
    const SceneRenderer::Shot one = shot(i);
    singly.render(one.exposures, one.bodies, one.light, images);
    ASSERT_EQ(images.size(), 3U);
    EXPECT_TRUE(same(together[i], images)) << i;
    EXPECT_TRUE(i == 0 || !same(together[0], images)) << i;
  }
}

TEST_F(Shots, QuicklyPaintedDependOnNothingThatWasPaintedBefore) {
  SceneRenderer batch(scene_, 3);
  std::vector<SceneRenderer::Shot> shots;
  for (std::uint64_t i = 0; i < kShots; ++i) shots.push_back(shot(i));
  const auto together = pictures(batch, std::move(shots), Detail::quick);
  SceneRenderer singly(scene_, 1);
  std::vector<GreyImage> between;
  for (std::uint64_t i = kShots; i-- > 0;) {
    EXPECT_TRUE(same(together[i], pictures(singly, {shot(i)}, Detail::quick)[0])) << i;
    singly.render(exposures_at(0.0, 0), between);
  }
}

// Of the still hall the sums are the same but for roundings; bodies and shadows are coarser.
TEST_F(Shots, QuicklyPaintedAreNearlyTheCarefulOnes) {
  SceneRenderer renderer(scene_, 2);
  for (std::uint64_t i = 0; i < kShots; ++i) {
    SceneRenderer::Shot bare = shot(i);
    bare.bodies = {};
    const auto still = pictures(renderer, {bare}, Detail::full)[0];
    const auto quick_still = pictures(renderer, {bare}, Detail::quick)[0];
    const auto full = pictures(renderer, {shot(i)}, Detail::full)[0];
    const auto quick = pictures(renderer, {shot(i)}, Detail::quick)[0];
    for (std::size_t c = 0; c < full.size(); ++c) {
      int most_still = 0;
      int pixels_off = 0;
      for (std::size_t p = 0; p < full[c].pixels().size(); ++p) {
        most_still =
            std::max(most_still, std::abs(still[c].pixels()[p] - quick_still[c].pixels()[p]));
        pixels_off += std::abs(full[c].pixels()[p] - quick[c].pixels()[p]) > 8 ? 1 : 0;
      }
      EXPECT_LE(most_still, 1) << i << " " << c;
      EXPECT_LE(pixels_off, 64 * 48 / 20) << i << " " << c;
    }
  }
}

TEST(ForEachIndex, DoesEachPieceOnceAndPassesOnWhatOneThrows) {
  std::vector<std::atomic<int>> done(100);
  for_each_index(done.size(), 4, [&](std::size_t i) { ++done[i]; });
  for (const auto& times : done) EXPECT_EQ(times, 1);
  std::atomic<int> ended = 0;
  EXPECT_THROW(for_each_index(20, 4,
                              [&](std::size_t i) {
                                if (i == 7) throw std::runtime_error("seven");
                                ++ended;
                              }),
               std::runtime_error);
  EXPECT_EQ(ended, 19);
}

}  // namespace
}  // namespace dottrack::host_sim
