// A picture of the middle of a board may show any part of it: nobody can tell which dot is which.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/workstation/calibrate/labelling/observe.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/workstation/calibrate/painted_hall.h"

namespace dottrack::calibrate {
namespace {

test::PaintedHall wide_board() {
  test::PaintedHall board = test::painted_plate();
  board.dots.clear();
  for (int i = 0; i < 40 * 40; ++i) {
    SurveyedDot dot;
    dot.name = std::to_string(i);
    dot.position_m = Eigen::Vector3d(0.005 * (i % 40 - 16), 0.005 * (i / 40 - 16), 0.0);
    dot.diameter_m = 0.0015;
    dot.normal = Eigen::Vector3d::UnitZ();
    board.dots.push_back(dot);
  }
  return board;
}

TEST(GridPart, IsRefused) {
  const test::TemporaryFolder folder;
  const test::PaintedHall board = wide_board();
  const auto inputs = test::paint(board, folder.path());
  const auto observed = observe(board.dots, inputs);
  ASSERT_FALSE(observed);
  EXPECT_THAT(observed.error().message, testing::HasSubstr("its dots fit the survey in"));
}

}  // namespace
}  // namespace dottrack::calibrate
