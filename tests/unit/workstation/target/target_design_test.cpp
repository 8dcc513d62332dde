// Designed targets pass their own judgement, with room around every dot.

#include "app/workstation/target/target_design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "app/config/target_judgement.h"
#include "app/workstation/target/target_table.h"

namespace dottrack::workstation {
namespace {

constexpr Panel kPanel{1.2, 0.8};

core::Target design_or_fail(const DesignRequest& request) {
  const Result<core::Target> target = design_target(request);
  if (!target) throw std::runtime_error(target.error().message);
  return *target;
}

void expect_room(const core::Target& target, const Panel& panel) {
  for (std::size_t i = 0; i < target.dots.size(); ++i) {
    const core::TargetDot& dot = target.dots[i];
    const double margin_m = kMargin_diameters * dot.diameter_m - 1e-9;
    EXPECT_LE(std::abs(dot.position_m.x()) + margin_m, 0.5 * panel.length_m);
    EXPECT_LE(std::abs(dot.position_m.y()) + margin_m, 0.5 * panel.width_m);
    EXPECT_EQ(dot.position_m.z(), 0.0);
    EXPECT_EQ(dot.normal, Eigen::Vector3d(0, 0, 1));
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((dot.position_m - target.dots[j].position_m).norm(),
                kSpacing_diameters * dot.diameter_m - 1e-9);
    }
  }
}

class EveryCount : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryCount, IsGoodByItsOwnJudgement) {
  const DesignRequest request{.dots = GetParam(), .panel = kPanel};
  const core::Target target = design_or_fail(request);
  ASSERT_EQ(target.dots.size(), GetParam());
  expect_room(target, kPanel);
  const config::TargetJudgement judgement = config::judge(target, request.sigma_m);
  EXPECT_TRUE(good(judgement));
  EXPECT_FALSE(judgement.most.has_value()) << "some four of its dots can be mistaken";
  EXPECT_LT(judgement.conditioning.attitude_deg_per_mm, 0.12);
}

INSTANTIATE_TEST_SUITE_P(Dots, EveryCount, testing::Range<std::size_t>(3, 17));

TEST(TargetDesign, IsGoodInAnyAttitudeToo) {
  DesignRequest request{.dots = 6, .panel = kPanel};
  request.upright = false;
  const core::Target target = design_or_fail(request);
  EXPECT_FALSE(target.upright);
  EXPECT_FALSE(config::judge(target, request.sigma_m).most.has_value());
}

TEST(TargetDesign, FitsASheetOfPaper) {
  const Panel sheet{0.26, 0.18};
  const core::Target target = design_or_fail({.dots = 8, .panel = sheet, .sigma_m = 0.0005});
  expect_room(target, sheet);
  EXPECT_TRUE(good(config::judge(target, 0.0005)));
  const double tenths = target.dots[0].position_m.x() * 1e4;
  EXPECT_NEAR(tenths, std::round(tenths), 1e-6);
}

TEST(TargetDesign, IsTheSameForTheSameRequest) {
  DesignRequest request{.dots = 6, .panel = kPanel};
  const auto first_x = [&] { return design_or_fail(request).dots[0].position_m.x(); };
  const double once = first_x();
  EXPECT_EQ(first_x(), once);
  request.seed = 2;
  EXPECT_NE(first_x(), once);
}

TEST(TargetDesign, DotsAreAsLargeAsThereIsRoom) {
  EXPECT_EQ(suitable_diameter_m(3, kPanel), 0.050);
  EXPECT_EQ(suitable_diameter_m(16, kPanel), 0.040);
  EXPECT_NEAR(suitable_diameter_m(4, {0.2, 0.3}), 0.020, 1e-12);
}

TEST(TargetDesign, SaysWhenDotsHaveNoRoom) {
  const Result<core::Target> target =
      design_target({.dots = 16, .panel = {0.38, 0.25}, .diameter_m = 0.05});
  ASSERT_FALSE(target.has_value());
  EXPECT_EQ(target.error().message,
            "16 dots of 0.05 m have no room on a panel of 0.38 x 0.25 m; expected room for 3 "
            "diameters from dot to dot and 1.5 from dot to edge: a larger panel or a smaller "
            "--diameter");
}

}  // namespace
}  // namespace dottrack::workstation
