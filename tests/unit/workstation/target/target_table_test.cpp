// What `dottrack target check` prints.

#include "app/workstation/target/target_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/workstation/target/target_design.h"

namespace dottrack::workstation {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

const std::vector<std::string> kNames{"a", "b", "c", "d", "e"};

core::Target square() {
  core::Target target;
  for (const auto& [x, y] : {std::pair(0.3, 0.3), {-0.3, 0.3}, {-0.3, -0.3}, {0.3, -0.3}}) {
    target.dots.push_back({{x, y, 0.0}, 0.05, std::nullopt});
  }
  return target;
}

std::string table_of(const core::Target& target, double sigma_m = 0.002) {
  return target_table(target, config::judge(target, sigma_m, kAmple),
                      std::span(kNames).first(target.dots.size()));
}

TEST(TargetTable, OfAnAmbiguousTarget) {
  EXPECT_EQ(table_of(square()),
            "dots          4, upright, their places known to 2 mm\n"
            "distances     0.6 to 0.8485 m\n"
            "attitude      0.19 degrees about the worst axis (0.095 a mm)\n"
            "position      of the origin 1.00 mm along the worst axis (0.500 a mm)\n"
            "relabelled        misfit     needed    ratio\n"
            "all 4 dots        0.0 mm     9.0 mm     0.00  dots \"a\" \"b\" \"c\" \"d\" taken for "
            "\"b\" \"c\" \"d\" \"a\", turned by 90 degrees\n"
            "ambiguous: move dot \"a\" by 18.6 mm to 0.3186,0.3000,0.0000\n");
  EXPECT_FALSE(good(config::judge(square(), 0.002)));
}

TEST(TargetTable, IsTheOneOfTheManual) {
  std::ostringstream manual;
  manual << std::ifstream(DOTTRACK_SOURCE_DIR "/docs/targets.md").rdbuf();
  core::Target target = square();
  for (core::TargetDot& dot : target.dots) dot.position_m.z() = 0.5;
  const std::vector<std::string> names{"1", "2", "3", "4"};
  EXPECT_THAT(manual.str(),
              HasSubstr(target_table(target, config::judge(target, 0.002, kAmple), names)));
  const core::Target design = *design_target({.dots = 8, .panel = {1.2, 0.8}});
  const std::vector<std::string> numbers(8);
  EXPECT_THAT(manual.str(),
              HasSubstr(target_table(design, config::judge(design, 0.002, kAmple), numbers)));
}

TEST(TargetTable, OfATargetThatIsGoodWhileAllDotsAreSeen) {
  core::Target target = square();
  target.dots.push_back({{0.05, 0.11, 0.0}, 0.05, std::nullopt});
  EXPECT_THAT(table_of(target),
              EndsWith("good while all of its 5 dots are seen: 4 can be mistaken for others\n"));
  EXPECT_TRUE(good(config::judge(target, 0.002)));
}

TEST(TargetTable, OfAGoodTarget) {
  core::Target target = square();
  target.dots[0].position_m.x() = 0.6;
  EXPECT_THAT(table_of(target), EndsWith("\ngood: no 4 of its dots can be mistaken for others\n"));
  EXPECT_THAT(table_of(target), HasSubstr("\nall 4 dots      >36.0 mm     9.0 mm    >4.00"))
      << table_of(target);
}

TEST(TargetTable, OfABadlyConditionedTarget) {
  core::Target target;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.4, 0.05}, {1.1, 0.0}}) {
    target.dots.push_back({{x, y, 0.0}, 0.05, std::nullopt});
  }
  EXPECT_THAT(table_of(target),
              EndsWith("\nbadly conditioned: place the dots farther apart, or farther from one "
                       "line; 2 degrees or better are needed\n"));
  EXPECT_FALSE(good(config::judge(target, 0.002)));
}

}  // namespace
}  // namespace dottrack::workstation
