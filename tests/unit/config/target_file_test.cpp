#include "app/config/target_file.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace dottrack::config {
namespace {

TargetDots parse_or_fail(const std::string& text) {
  Result<TargetFile> file = parse_target_text(text, "target.csv");
  if (!file) throw std::runtime_error(file.error().message);
  return file->dots;
}

TEST(TargetFile, ReadsPositionsAndDiameters) {
  const TargetDots dots = parse_or_fail(
      "dot,x_m,y_m,z_m,diameter_m\n"
      "0,0.1,-0.2,+0.5,0.05\n"
      "1,1e-1,0.7,0.6,0.06\n"
      "2,.9,0.2,0.5,5E-2\n");
  ASSERT_EQ(dots.size(), 3U);
  EXPECT_EQ(dots[0].position_m, Eigen::Vector3d(0.1, -0.2, 0.5));
  EXPECT_EQ(dots[1].position_m, Eigen::Vector3d(0.1, 0.7, 0.6));
  EXPECT_EQ(dots[1].diameter_m, 0.06);
  EXPECT_EQ(dots[2].diameter_m, 0.05);
  EXPECT_FALSE(dots[0].normal.has_value());
}

TEST(TargetFile, TakesBlankLinesCommentsSpacesCrlfAndAByteOrderMark) {
  const TargetDots dots = parse_or_fail(
      "\xEF\xBB\xBF# three dots\r\n\r\n dot, x_m, y_m, z_m, diameter_m\r\n"
      "left, 0.0, 0.0, 0.5, 0.1\r\n  # in between\r\n\r\n"
      "right, 1.0, 0.0, 0.5, 0.1 \r\n"
      "mast, 0.0, 0.7, 0.6, 0.1");
  ASSERT_EQ(dots.size(), 3U);
  EXPECT_EQ(dots[2].position_m, Eigen::Vector3d(0.0, 0.7, 0.6));
}

TEST(TargetFile, MakesNormalsExactlyUnitAndLeavesEmptyOnesOut) {
  const TargetDots dots = parse_or_fail(
      "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz\n"
      "0,0,0,0.5,0.1,0,0,1.0009\n"
      "1,1,0,0.5,0.1,,,\n"
      "2,0,0.7,0.6,0.1,0.6,0,0.8\n");
  ASSERT_TRUE(dots[0].normal.has_value());
  EXPECT_EQ(*dots[0].normal, Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(dots[1].normal.has_value());
  ASSERT_TRUE(dots[2].normal.has_value());
  EXPECT_NEAR(dots[2].normal->norm(), 1.0, 1e-15);
}

TEST(TargetFile, TakesSixteenDots) {
  std::string text = "dot,x_m,y_m,z_m,diameter_m\n";
  for (int i = 0; i < 16; ++i) {
    text += std::to_string(i) + "," + std::to_string(i % 4) + "," + std::to_string(i / 4) +
            ",0.5,0.1\n";
  }
  EXPECT_EQ(parse_or_fail(text).size(), 16U);
}

TEST(TargetFile, TakesDotsThatTouch) {
  EXPECT_EQ(parse_or_fail("dot,x_m,y_m,z_m,diameter_m\n"
                          "0,0,0,0,0.5\n1,0.5,0,0,0.5\n2,0,0.5,0,0.5\n")
                .size(),
            3U);
}

TEST(TargetFile, TakesASlimTriangle) {
  EXPECT_EQ(parse_or_fail("dot,x_m,y_m,z_m,diameter_m\n"
                          "0,0,0,0,0.01\n1,1,0,0,0.01\n2,0.5,0.011,0,0.01\n")
                .size(),
            3U);
}

TEST(TargetFile, ReadsTheFile) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("rover.csv",
                                 "dot,x_m,y_m,z_m,diameter_m\n"
                                 "0,0,0,0.5,0.1\n1,1,0,0.5,0.1\n2,0,0.7,0.6,0.1\n");
  const Result<TargetFile> file = read_target_file(path);
  ASSERT_TRUE(file.has_value()) << file.error().message;
  EXPECT_EQ(file->dots.size(), 3U);
  EXPECT_EQ(file->names, (std::vector<std::string>{"0", "1", "2"}));
  EXPECT_EQ(file->lines, (std::vector<std::size_t>{2, 3, 4}));
}

}  // namespace
}  // namespace dottrack::config
