#include "app/workstation/svg_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(RoundStep, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_step(10.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(round_step(11.0, 10), 2.0);
  EXPECT_DOUBLE_EQ(round_step(0.3, 10), 0.05);
  EXPECT_DOUBLE_EQ(round_step(6000.0, 10), 1000.0);
  EXPECT_DOUBLE_EQ(round_step(22.0, 11), 2.0);
}

TEST(SvgChart, DrawsALineThatBreaksWhereThereIsNoValue) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Chart chart{
      .title = "a < b",
      .x_label = "x",
      .y_label = "y",
      .series = {{"one", "#123456", Style::line, {{0, 0}, {1, 1}, {2, none}, {3, 2}}}}};
  const std::string text = svg(std::array{chart});
  EXPECT_THAT(text, HasSubstr("a &lt; b"));
  EXPECT_EQ(text.find("nan"), std::string::npos);
  const auto path = text.substr(text.find("<path d='"));
  const std::string data = path.substr(0, path.find("' fill"));
  EXPECT_EQ(count_of(data, "M"), 2U);
  EXPECT_EQ(count_of(data, "L"), 1U);
}

// 10 m along x and 5 m along y: the axes are twice as wide as high.
TEST(SvgChart, KeepsAMapsScales) {
  const Chart chart{.series = {{"", "#000", Style::line, {{0, 0}, {10, 0}, {10, 5}, {0, 5}}}},
                    .equal_scales = true};
  const std::string text = svg(std::array{chart});
  // The ranges are widened on both sides, x by 3 % and y by 6 %.
  EXPECT_THAT(text, HasSubstr("width='860' height='454.3'"));
}

TEST(SvgChart, PutsChartsOneBelowTheOther) {
  const Chart chart{.title = "t", .series = {{"", "#000", Style::points, {{0, 0}, {1, 1}}}}};
  const std::string one = svg(std::array{chart});
  const std::string two = svg(std::array{chart, chart});
  EXPECT_EQ(count_of(one, "<circle"), 2U);
  EXPECT_EQ(count_of(two, "<circle"), 4U);
  EXPECT_THAT(one, HasSubstr("height='358'"));
  EXPECT_THAT(two, HasSubstr("height='716'"));
}

TEST(SvgChart, ABarIsAsHighAsItsValueSays) {
  const Chart chart{.series = {{"", "#abc", Style::bars, {{0, 4}, {1, 2}, {2, 0}}}},
                    .y_from_zero = true};
  const std::string text = svg(std::array{chart});
  EXPECT_EQ(count_of(text, "fill='#abc'"), 2U);
  // 260 px for 4 and a margin of 6 % above: 245.3 px and half of that.
  EXPECT_THAT(text, HasSubstr("height='245.3' fill='#abc'"));
  EXPECT_THAT(text, HasSubstr("height='122.6' fill='#abc'"));
}

TEST(SvgChart, WithoutAnyPointIsAnEmptyChart) {
  const std::string text = svg(std::array{Chart{.title = "nothing"}});
  EXPECT_THAT(text, HasSubstr("nothing"));
  EXPECT_THAT(text, HasSubstr("</svg>"));
}

}  // namespace
}  // namespace dottrack::workstation
