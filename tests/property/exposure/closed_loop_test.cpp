// Light control in a closed loop with random cameras and lenses: it settles, saturates no longer
// than that takes, and never hunts.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/exposure/lit_camera.h"

namespace dottrack::exposure_test {
namespace {

using exposure::IrisCondition;
using exposure::LightSettings;
using exposure::LightState;

constexpr int kPlants = 200;
constexpr int kSettle_ticks = 30;  // a second at 30 Hz
constexpr double kTarget_dn = 191.0;
constexpr double kTolerance = 1.25;

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : random_(seed) {}
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  // Evenly in proportions.
  double factor(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

 private:
  std::mt19937 random_;
};

LightSettings settings() {
  LightSettings settings{.on = true};
  settings.start.fill({std::chrono::milliseconds(4), 1.0});
  return settings;
}

Plant random_plant(std::uint32_t seed) {
  Dice dice(seed);
  Plant plant;
  plant.light_dn_per_s = dice.factor(2e4, 1e6);
  plant.ground = dice.uniform(0.1, 0.5);
  plant.delay_ticks = dice.whole(1, 4);
  plant.opening = dice.uniform(0.3, 1.0);
  plant.backlash = dice.uniform(0.0, 0.05);
  plant.speed_per_tick = dice.uniform(0.005, 0.05);
  plant.noise = dice.uniform(0.0, 0.02);
  plant.seed = seed;
  return plant;
}

bool right(const LitCamera& camera) {
  return camera.level_dn() < kTolerance * kTarget_dn && camera.level_dn() * kTolerance > kTarget_dn;
}

// What the ticks until the next change of the light come to.
struct Course {
  int settled_after = -1;  // from then on the level is right in every tick
  int saturated = 0;
  int orders_when_settled = 0;
  bool overshot = false;  // saturated after it had not been
};

Course watch(LitCamera& camera, int ticks) {
  Course course;
  int last_wrong = -1;
  bool was_unsaturated = false;
  int orders = camera.exposures_ordered();
  for (int tick = 0; tick < ticks; ++tick) {
    camera.tick();
    if (!right(camera)) last_wrong = tick;
    if (camera.saturated()) ++course.saturated;
    course.overshot = course.overshot || (was_unsaturated && camera.saturated());
    was_unsaturated = was_unsaturated || !camera.saturated();
    if (tick == kSettle_ticks) orders = camera.exposures_ordered();
  }
  course.settled_after = last_wrong + 1;
  course.orders_when_settled = camera.exposures_ordered() - orders;
  return course;
}

// Within what exposure and gain can do: a sun lamp's light is some 30 times a dim hall's.
TEST(LightControlClosedLoop, SettlesAfterEverySwitchWithoutOvershootOrHunting) {
  int switches = 0;
  int worst = 0;
  for (std::uint32_t seed = 1; seed <= kPlants; ++seed) {
    const Plant plant = random_plant(seed);
    LitCamera camera(plant, settings());
    Dice dice(seed + 10000);
    for (int change = 0; change < 4; ++change) {
      if (change > 0) camera.set_light(dice.factor(2e4, 1e6));
      const Course course = watch(camera, 120);
      SCOPED_TRACE(testing::Message() << "plant " << seed << " change " << change);
      ASSERT_LE(course.settled_after, kSettle_ticks);
      ASSERT_LE(course.saturated, kSettle_ticks);
      ASSERT_FALSE(course.overshot);
      ASSERT_LE(course.orders_when_settled, 4) << "of 90 ticks in which nothing changed";
      worst = std::max(worst, course.settled_after);
      ++switches;
    }
  }
  EXPECT_EQ(switches, 4 * kPlants);
  RecordProperty("worst_settling_ticks", worst);
}

TEST(LightControlClosedLoop, FollowsDriftWithoutTurningBack) {
  int reversals = 0;
  int orders = 0;
  for (std::uint32_t seed = 1; seed <= kPlants; ++seed) {
    Plant plant = random_plant(seed);
    plant.wear_per_tick = Dice(seed + 20000).uniform(-0.002, 0.002);
    plant.opening = 0.6;  // so that the iris may rest
    plant.light_dn_per_s = std::max(plant.light_dn_per_s, 1e5);
    LitCamera camera(plant, settings());
    watch(camera, 60);
    double last = 0.0;
    int direction = 0;
    for (int tick = 0; tick < 600; ++tick) {
      camera.tick();
      ASSERT_FALSE(camera.saturated()) << "plant " << seed << " tick " << tick;
      const double product =
          to_seconds(camera.light().setting.exposure) * camera.light().setting.gain;
      if (last > 0.0 && std::abs(product / last - 1.0) > 0.02) {
        const int now = product > last ? 1 : -1;
        reversals += direction != 0 && now != direction ? 1 : 0;
        direction = now;
        ++orders;
      }
      last = product;
    }
  }
  EXPECT_GT(orders, 2 * kPlants);
  EXPECT_LE(reversals, orders / 20);
}

// More than exposure and gain can do: the iris has to help.
TEST(LightControlClosedLoop, OpensAndClosesTheIrisWhereNothingElseHelps) {
  int opened = 0;
  int closed = 0;
  for (std::uint32_t seed = 1; seed <= kPlants / 4; ++seed) {
    Plant plant = random_plant(seed);
    plant.opening = 0.3;
    plant.light_dn_per_s = 6000.0;
    LitCamera dark(plant, settings());
    watch(dark, 600);
    ASSERT_TRUE(right(dark)) << "plant " << seed << ": " << dark.level_dn();
    opened += dark.opening() > 0.5 ? 1 : 0;
    const int moves = dark.moves_ordered();
    watch(dark, 300);
    ASSERT_EQ(dark.moves_ordered(), moves) << "plant " << seed;

    plant.opening = 1.0;
    plant.light_dn_per_s = 2e7;
    LitCamera bright(plant, settings());
    watch(bright, 600);
    ASSERT_TRUE(right(bright)) << "plant " << seed << ": " << bright.level_dn();
    closed += bright.opening() < 0.5 ? 1 : 0;
  }
  EXPECT_EQ(opened, kPlants / 4);
  EXPECT_EQ(closed, kPlants / 4);
}

TEST(LightControlClosedLoop, NamesAnIrisThatIsStuckAndNoOther) {
  for (std::uint32_t seed = 1; seed <= kPlants / 4; ++seed) {
    Plant plant = random_plant(seed);
    plant.opening = 0.3;
    plant.light_dn_per_s = 6000.0;
    LitCamera sound(plant, settings());
    plant.stuck = true;
    LitCamera stuck(plant, settings());
    int named_after = -1;
    for (int tick = 0; tick < 300; ++tick) {
      sound.tick();
      stuck.tick();
      ASSERT_NE(sound.light().state, LightState::iris_fault)
          << "plant " << seed << " tick " << tick;
      if (named_after < 0 && stuck.light().state == LightState::iris_fault) named_after = tick;
    }
    ASSERT_GE(named_after, 0) << "plant " << seed;
    EXPECT_EQ(stuck.light().iris, IrisCondition::fault);
    EXPECT_NE(sound.light().iris, IrisCondition::fault);
    EXPECT_TRUE(stuck.automatic()) << "given back to its lens";
  }
}

// Exposure and gain do all that is needed: the iris has no reason to move but to be tried.
int named_after(const Plant& plant, double factor) {
  LitCamera camera(plant, settings());
  watch(camera, 120);
  camera.stick(true);
  camera.set_light(factor * plant.light_dn_per_s);
  for (int tick = 0; tick < 120; ++tick) {
    camera.tick();
    if (camera.light().state == LightState::iris_fault) return tick;
  }
  return -1;
}

TEST(LightControlClosedLoop, FindsAStuckIrisWhenTheLightChangesThoughExposureSuffices) {
  int found = 0;
  for (std::uint32_t seed = 1; seed <= kPlants / 4; ++seed) {
    Plant plant = random_plant(seed);
    plant.opening = Dice(seed + 30000).uniform(0.4, 0.9);
    plant.light_dn_per_s = Dice(seed + 40000).factor(1.5e5, 4e5);
    plant.speed_per_tick = 0.0167;  // half of the whole way in a second at 30 Hz
    for (const double factor : {0.5, 1.8}) {
      const int after = named_after(plant, factor);
      ASSERT_GE(after, 0) << "plant " << seed << " light times " << factor;
      EXPECT_LE(after, 60) << "plant " << seed << " light times " << factor;
      ++found;
    }
  }
  EXPECT_EQ(found, kPlants / 2);
}

TEST(LightControlClosedLoop, NamesNoSoundIrisThatItExercises) {
  int moves = 0;
  for (std::uint32_t seed = 1; seed <= kPlants; ++seed) {
    Plant plant = random_plant(seed);
    plant.opening = Dice(seed + 60000).uniform(0.4, 0.6);  // with wear, never fully open
    plant.wear_per_tick = Dice(seed + 50000).uniform(-0.001, 0.001);
    LitCamera camera(plant, settings());
    for (int tick = 0; tick < 300; ++tick) {
      camera.tick();
      ASSERT_NE(camera.light().state, LightState::iris_fault) << "plant " << seed << " " << tick;
    }
    moves += camera.moves_ordered();
  }
  EXPECT_GT(moves, 3 * kPlants);
}

TEST(LightControlClosedLoop, SaysWhenNothingIsLeftToDo) {
  Plant plant;
  plant.light_dn_per_s = 800.0;
  plant.opening = 1.0;
  LitCamera dark(plant, settings());
  watch(dark, 200);
  EXPECT_EQ(dark.light().state, LightState::too_dark);
  EXPECT_EQ(dark.light().iris, IrisCondition::at_end);
  plant.light_dn_per_s = 3e8;
  LitCamera bright(plant, settings());
  watch(bright, 1500);
  EXPECT_EQ(bright.light().state, LightState::too_bright);
  EXPECT_EQ(bright.light().iris, IrisCondition::at_end);
}

// Nothing known of the dots: some tick or other shows them well, whatever the light.
TEST(LightControlClosedLoop, SpreadsExposuresWhileThereIsNoLock) {
  for (const double light : {2e3, 2e4, 2e5, 2e6}) {
    Plant plant;
    plant.light_dn_per_s = light;
    plant.opening = 1.0;
    LitCamera camera(plant, settings());
    camera.hide(true);
    int good = 0;
    for (int tick = 0; tick < 150; ++tick) {
      camera.tick();
      good += camera.level_dn() > 60.0 && camera.level_dn() < 250.0 ? 1 : 0;
    }
    EXPECT_GE(good, 30) << light;
  }
}

}  // namespace
}  // namespace dottrack::exposure_test
