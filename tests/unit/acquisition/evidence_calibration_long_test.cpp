// Whether a false-lock probability means what it says: over many random scenes its mean is the rate
// of wrong selections. The tables of docs/false-locks.md are what these tests print.

#include <gtest/gtest.h>

#include "tests/unit/acquisition/calibration.h"

namespace dottrack::acquisition {
namespace {

using test::calibrate;
using test::Calibration;
using test::ClutterKind;
using test::FinalistScene;
using test::is_wrong;
using test::kLimit_m;

TEST(EvidenceCalibration, OverManyScenes) {
  const Calibration calibration = calibrate({1001, 30000, {3, 3, 3, 3, 3, 4, 4, 5}});
  EXPECT_GE(calibration.row("all").candidates, 10000.0);
  EXPECT_GE(calibration.row("all").wrong, 1000.0);
  EXPECT_GE(calibration.check(), 7);
  // What the default limit of a lock lets through.
  EXPECT_GE(calibration.row("probability below 1e-6").candidates, 1000.0);
  EXPECT_EQ(calibration.row("probability below 1e-6").wrong, 0.0);
}

// Dots of a large target are hidden in most scenes: it is selected in part.
TEST(EvidenceCalibration, OfTargetsInPart) {
  const Calibration calibration = calibrate({1002, 2400, {8, 6, 6, 6, 6, 6, 6, 6}});
  EXPECT_GE(calibration.row("all").wrong, 60.0);
  EXPECT_GE(calibration.check(), 4);
  EXPECT_EQ(calibration.row("probability below 1e-6").wrong, 0.0);
}

// Three dots of a larger target, where no four of them are certain.
TEST(EvidenceCalibration, OfThreeDotsOfMore) {
  const Calibration calibration = calibrate({1004, 12000, {4, 5, 5, 5, 5, 5, 5, 6}});
  EXPECT_GE(calibration.row("3 dots matched").candidates, 2000.0);
  EXPECT_GE(calibration.row("3 dots matched").wrong, 200.0);
  EXPECT_GE(calibration.check(), 5);
  EXPECT_GE(calibration.row("probability below 1e-6").candidates, 1000.0);
  EXPECT_EQ(calibration.row("probability below 1e-6").wrong, 0.0);
}

// The search ends among these when what it finds is certain enough: clutter of fewer views that
// crowds around it has not been looked for.
TEST(EvidenceCalibration, OfFinalistsOfManyViewsAlone) {
  const Calibration calibration = calibrate({1003, 24000, {3, 3, 3, 3, 3, 4, 4, 4}, 6});
  EXPECT_GE(calibration.row("all").candidates, 3000.0);
  EXPECT_GE(calibration.row("all").wrong, 300.0);
  EXPECT_GE(calibration.check(), 4);
  EXPECT_GE(calibration.row("probability below 1e-6").candidates, 500.0);
  EXPECT_EQ(calibration.row("probability below 1e-6").wrong, 0.0);
}

// Something that looks exactly like the target stands around. With both to be seen each is the
// other's rival.
TEST(EvidenceCalibration, BesideAnExactCopy) {
  Calibration calibration;
  test::SceneMaker make(1005);
  test::Finder finder;
  int sure = 0;
  for (int i = 0; i < 600; ++i) {
    FinalistScene scene;
    scene.target = make.target(4);
    scene.noise_m = make.log_uniform(0.001, 0.005);
    make.add_clutter(scene, static_cast<ClutterKind>(i % 3), 60);
    const double survey_m = make.log_uniform(0.0003, 0.004);
    scene.truth = make.upright_pose();
    make.add_target(scene, *scene.truth, survey_m, 0.0);
    make.add_target(scene, make.upright_pose(), survey_m, 0.0);
    const auto lock = finder.find(scene, kLimit_m);
    ASSERT_TRUE(lock);
    const double p = false_lock_probability(lock->log_odds, as_span(lock->rivals));
    calibration.add("beside an exact copy", p, is_wrong(scene, *lock));
    if (p < 1e-6) ++sure;
  }
  EXPECT_EQ(calibration.check(), 1);
  EXPECT_LE(sure, 6);
}

}  // namespace
}  // namespace dottrack::acquisition
