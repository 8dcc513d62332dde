// A whole scene through all of its cameras, on several threads.

#include "host_sim/scenarios/scene_renderer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "host_sim/scenarios/parallel.h"
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
