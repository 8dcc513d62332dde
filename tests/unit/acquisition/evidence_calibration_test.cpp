#include <gtest/gtest.h>

#include "tests/unit/acquisition/calibration.h"

namespace dottrack::acquisition {
namespace {

// In short what evidence_calibration_long_test.cpp finds over many scenes.
TEST(EvidenceCalibration, OfThreeDotsInShort) {
  const test::Calibration calibration = test::calibrate({11, 600, {3, 3, 3, 3, 3, 3, 3, 3}});
  EXPECT_GE(calibration.row("all").wrong, 80.0);
  EXPECT_GE(calibration.check(), 3);
}

}  // namespace
}  // namespace dottrack::acquisition
