// Acquisition's bound of work, where everything is as bad as it can be.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "app/core/acquisition/acquisition.h"
#include "tests/support/lattice_scene.h"

namespace dottrack::acquisition {
namespace {

constexpr std::uint64_t kUnits = 200'000;
// A step that has begun is finished. The longest that begins without asking is to sort candidates
// in, once a bound of selection.
constexpr std::uint64_t kOvershoot = core::kMaxFinalists + 1000;

TEST(WorstCase, EveryTickStaysWithinItsBudget) {
  const auto scene = std::make_unique<test::LatticeScene>();
  for (const image::Regions* regions : scene->regions()) {
    ASSERT_GE(regions->size(), core::kMaxRegions * 9 / 10);
  }
  const auto acquisition = std::make_unique<Acquisition>(scene->rig, scene->optics);
  WorkBudget budget(kUnits);
  acquisition->start(scene->regions(), budget);
  EXPECT_GT(budget.spent(), 0U);
  int full_ticks = 0;
  for (int tick = 0; tick < 60 && acquisition->busy(); ++tick) {
    acquisition->go_on(budget);
    ASSERT_LE(budget.spent(), kUnits + kOvershoot) << tick;
    full_ticks += acquisition->busy() ? 1 : 0;
    budget = WorkBudget(kUnits);
  }
  EXPECT_GE(full_ticks, 10);  // it was work enough to need its bound
  EXPECT_GE(acquisition->result().counts.finalists, core::kMaxFinalists / 10);
}

}  // namespace
}  // namespace dottrack::acquisition
