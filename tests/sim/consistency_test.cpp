// Covariances held against the truth in many halls: the sums, and a short run.

#include "app/workstation/consistency.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/small_scenario.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;

PoseError error(double x_mm, double nees) {
  PoseError made;
  made.position_m = Eigen::Vector3d(0.001 * x_mm, 0.0, 0.0);
  made.nees = nees;
  return made;
}

TEST(ConsistencyTest, SumsPosesUp) {
  const Consistency of =
      consistency_of(std::vector{error(1.0, 3.0), error(-1.0, 12.5), error(2.0, 12.7)});
  EXPECT_EQ(of.poses, 3U);
  EXPECT_NEAR(of.position_rms_mm, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(of.nees_mean, 9.4, 1e-9);
  EXPECT_NEAR(of.inside, 2.0 / 3.0, 1e-9);
  EXPECT_EQ(consistency_of({}).poses, 0U);
}

HallRun hall(const std::string& scenario, std::uint64_t seed, double nees) {
  const Consistency of{.poses = 10, .position_rms_mm = 0.5, .nees_mean = nees, .inside = 0.9};
  return {scenario, seed, of, of};
}

// The halls say how sure their mean is: 5 and 7 differ by 2, their mean is known to 1.
TEST(ConsistencyTest, TheTableHasTheMeanAndHowSureItIs) {
  const std::string table = consistency_table(
      std::vector{hall("drive", 1, 5.0), hall("drive", 2, 7.0), hall("ramp", 1, 4.0)});
  EXPECT_THAT(table,
              HasSubstr("| drive        | raw      |     2 |     20 |  0.50 mm |  6.00 +- 1.00 "
                        "|  90.0 % |"));
  EXPECT_THAT(table,
              HasSubstr("| ramp         | filtered |     1 |     10 |  0.50 mm |  4.00 +- 0.00 "
                        "|  90.0 % |"));
}

TEST(ConsistencyTest, SaysWhereThereAreNoPoses) {
  EXPECT_THAT(consistency_table(std::vector{HallRun{"empty", 1, {}, {}}}),
              HasSubstr("| empty        | raw      | no poses |"));
}

class HallsTest : public testing::Test {
 protected:
  void SetUp() override {
    options_.out = folder_.path() / "out";
    options_.halls = 2;
    options_.parts = {{folder_.write("small.toml", test::small_scenario()).string(), 4}};
  }

  test::TemporaryFolder folder_;
  ConsistencyOptions options_;
};

TEST_F(HallsTest, HaveDotsOfTheirOwnAndRepeat) {
  const auto runs = run_halls(options_);
  ASSERT_TRUE(runs) << runs.error().message;
  ASSERT_EQ(runs->size(), 2U);
  for (const HallRun& run : *runs) {
    EXPECT_EQ(run.scenario, "small");
    EXPECT_GE(run.raw.poses, 3U);
    EXPECT_EQ(run.filtered.poses, run.raw.poses);
    EXPECT_LT(run.raw.position_rms_mm, 5.0);
  }
  EXPECT_NE((*runs)[0].raw.position_rms_mm, (*runs)[1].raw.position_rms_mm);
  const auto target = [&](const char* hall) {
    return dottrack::text_of(options_.out / hall / "rig" / "target.csv");
  };
  EXPECT_GT(target("small_1").size(), 20U);
  EXPECT_NE(target("small_1"), target("small_2"));
  const auto again = run_halls(options_);
  ASSERT_TRUE(again);
  EXPECT_EQ(consistency_csv(*again), consistency_csv(*runs));
}

TEST_F(HallsTest, AreStoppedOnRequest) {
  options_.go_on = [](const std::string&) { return false; };
  const auto runs = run_halls(options_);
  ASSERT_FALSE(runs);
  EXPECT_EQ(runs.error().message, "stopped before all halls were done");
}

TEST_F(HallsTest, AreOfScenariosThatThereAre) {
  options_.parts = {{"no_such", 4}};
  const auto runs = run_halls(options_);
  ASSERT_FALSE(runs);
  EXPECT_THAT(runs.error().message, HasSubstr("no_such"));
}

}  // namespace
}  // namespace dottrack::workstation
