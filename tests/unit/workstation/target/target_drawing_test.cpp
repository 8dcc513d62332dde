// The drawing is true to scale, and the file reads back as the target.

#include "app/workstation/target/target_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "app/config/target_file.h"

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;

constexpr Panel kPanel{1.2, 0.8};

core::Target target() {
  core::Target target;
  target.dots.push_back({{-0.5, 0.3, 0}, 0.05, Eigen::Vector3d(0, 0, 1)});
  target.dots.push_back({{0.4, 0.1, 0}, 0.05, Eigen::Vector3d(0, 0, 1)});
  target.dots.push_back({{0.0, -0.275, 0}, 0.05, Eigen::Vector3d(0, 0, 1)});
  return target;
}

double number(const std::string& text, const std::string& pattern) {
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << pattern;
  return match.size() < 2 ? 0.0 : std::stod(match[1]);
}

TEST(TargetDrawing, AUnitIsAMillimetre) {
  const std::string svg = target_svg(target(), kPanel, core::Polarity::bright);
  const double width = number(svg, "<svg [^>]*width=\"([0-9.]+)mm\"");
  const double height = number(svg, "<svg [^>]*height=\"([0-9.]+)mm\"");
  EXPECT_EQ(number(svg, "viewBox=\"[-0-9.]+ [-0-9.]+ ([0-9.]+) "), width);
  EXPECT_EQ(number(svg, "viewBox=\"[-0-9.]+ [-0-9.]+ [0-9.]+ ([0-9.]+)\""), height);
  EXPECT_GT(width, 1200.0);
  EXPECT_GT(height, 800.0);
  EXPECT_THAT(svg, HasSubstr("<rect x=\"0\" y=\"0\" width=\"1200\" height=\"800\""));
}

// x to the right, y up; the panel's upper left corner is at 0, 0 of the drawing.
TEST(TargetDrawing, DotsAreWhereTheTargetHasThem) {
  const std::string svg = target_svg(target(), kPanel, core::Polarity::bright);
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"100\" cy=\"100\" r=\"25\" fill=\"#ffffff\"/>"));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"1000\" cy=\"300\" r=\"25\" fill=\"#ffffff\"/>"));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"600\" cy=\"675\" r=\"25\" fill=\"#ffffff\"/>"));
  for (const char* name : {">0</text>", ">1</text>", ">2</text>", ">x</text>", ">y</text>"}) {
    EXPECT_THAT(svg, HasSubstr(name));
  }
}

TEST(TargetDrawing, DarkDotsAreBlackOnWhite) {
  const std::string svg = target_svg(target(), kPanel, core::Polarity::dark);
  EXPECT_THAT(svg, HasSubstr("r=\"25\" fill=\"#000000\"/>"));
  EXPECT_THAT(svg, HasSubstr("width=\"1200\" height=\"800\" fill=\"#ffffff\""));
}

TEST(TargetDrawing, TheBarIsAsLongAsItSays) {
  for (const double length_m : {0.18, 0.5, 1.2, 3.0}) {
    const std::string svg = target_svg(target(), {length_m, 0.8}, core::Polarity::bright);
    const double bar = number(svg, ">([0-9.]+) mm</text>");
    EXPECT_LE(bar, 250.0 * length_m);
    EXPECT_GE(bar, 100.0 * length_m);
    const std::string tail = svg.substr(svg.rfind("<rect "));
    EXPECT_NEAR(number(tail, "x=\"([0-9.]+)\"") + number(tail, "width=\"([0-9.]+)\""), bar, 1e-3);
  }
}

TEST(TargetDrawing, TheFileReadsBack) {
  const auto file = config::parse_target_text(target_csv(target()), "target.csv");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  ASSERT_EQ(file->dots.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(file->dots[i].position_m, target().dots[i].position_m);
    EXPECT_EQ(file->dots[i].diameter_m, 0.05);
    EXPECT_EQ(file->dots[i].normal, Eigen::Vector3d(0, 0, 1));
  }
  EXPECT_EQ(file->names, (std::vector<std::string>{"0", "1", "2"}));
}

TEST(TargetDrawing, SaysHowToPrint) {
  EXPECT_EQ(how_to_print({0.25, 0.16}),
            "print on A4 at 100 %, not fitted to the page; the bar below the panel is then 50 mm "
            "long");
  EXPECT_THAT(how_to_print({0.16, 0.24}), HasSubstr("on A4"));
  EXPECT_THAT(how_to_print({0.38, 0.25}), HasSubstr("on A3"));
  EXPECT_THAT(how_to_print(kPanel), HasSubstr("as a poster on several sheets"));
}

}  // namespace
}  // namespace dottrack::workstation
