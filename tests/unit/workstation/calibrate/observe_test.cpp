// Pictures of surveyed dots to labels: rightly, or not at all and with a reason.

#include "app/workstation/calibrate/labelling/observe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.h"
#include "tests/unit/workstation/calibrate/painted_hall.h"

namespace dottrack::calibrate {
namespace {

using test::kPaintedColumns;
using test::kPaintedRows;
using test::PaintedHall;
using testing::HasSubstr;

constexpr std::size_t kHidden = 1;  // dots that something else lies over in part

class Observe : public testing::Test {
 protected:
  void use(const PaintedHall& hall) {
    hall_ = hall;
    inputs_ = test::paint(hall_, folder_.path());
  }
  void guess() {
    for (std::size_t c = 0; c < inputs_.size(); ++c) inputs_[c].approximate = hall_.guesses[c];
  }
  // What is said of the survey as it is now.
  std::string complaint() const {
    const auto observed = observe(hall_.dots, inputs_);
    return observed ? "none" : observed.error().message;
  }
  void expect_right(std::size_t least, double within_px = 0.5) const {
    const auto observed = observe(hall_.dots, inputs_);
    ASSERT_TRUE(observed) << observed.error().message;
    ASSERT_EQ(observed->views.size(), inputs_.size());
    for (std::size_t c = 0; c < inputs_.size(); ++c) {
      const test::Right right = right_ones(hall_, c, observed->views[c], within_px);
      EXPECT_GE(right.right + kHidden, right.all) << "camera " << c;
      EXPECT_GE(right.right, least) << "camera " << c;
    }
  }
  void blacken(std::size_t camera) {
    std::ofstream out(inputs_[camera].pictures.files.front(), std::ios::binary);
    out << "P5\n" << kPaintedColumns << " " << kPaintedRows << "\n255\n";
    out << std::string(static_cast<std::size_t>(kPaintedColumns) * kPaintedRows, '\x20');
  }

  test::TemporaryFolder folder_;
  PaintedHall hall_;
  std::vector<CameraInput> inputs_;
};

TEST_F(Observe, LabelsFromApproximateModels) {
  use(test::painted_hall());
  guess();
  expect_right(25);
}

TEST_F(Observe, LabelsFromPlaces) {
  use(test::painted_hall());
  for (std::size_t c = 0; c < inputs_.size(); ++c) {
    inputs_[c].near_m = geometry::centre(hall_.guesses[c]);
  }
  expect_right(25);
}

TEST_F(Observe, LabelsFromFourSeeds) {
  use(test::painted_hall());
  for (std::size_t c = 0; c < inputs_.size(); ++c) {
    for (const std::size_t dot : {9U, 14U, 27U, 29U}) {
      Seed seed{dot, Eigen::Vector2d::Zero()};
      ASSERT_EQ(geometry::project(hall_.truths[c], hall_.dots[dot].position_m, seed.pixel),
                geometry::OpticsStatus::ok);
      seed.pixel += Eigen::Vector2d(1.5, -1.0);
      inputs_[c].seeds.push_back(seed);
    }
  }
  expect_right(25);
}

TEST_F(Observe, LabelsAPlateFromScratch) {
  use(test::painted_plate());
  expect_right(60);
}

TEST_F(Observe, MeasuresDotsToATenthOfAPixel) {
  use(test::painted_hall());
  guess();
  expect_right(25, 0.1);
}

TEST_F(Observe, GivesTheSameForAnyNumberOfThreads) {
  use(test::painted_plate());
  ObserveOptions one;
  one.threads = 1;
  ObserveOptions three;
  three.threads = 3;
  const auto a = observe(hall_.dots, inputs_, one);
  const auto b = observe(hall_.dots, inputs_, three);
  ASSERT_TRUE(a && b);
  for (std::size_t c = 0; c < inputs_.size(); ++c) {
    ASSERT_EQ(a->views[c].observations.size(), b->views[c].observations.size());
    for (std::size_t i = 0; i < a->views[c].observations.size(); ++i) {
      EXPECT_EQ(a->views[c].observations[i].dot, b->views[c].observations[i].dot);
      EXPECT_EQ(a->views[c].observations[i].pixel, b->views[c].observations[i].pixel);
    }
  }
}

TEST_F(Observe, SaysThatTheSurveyHasTooFewDots) {
  use(test::painted_hall());
  guess();
  hall_.dots.resize(7);
  EXPECT_EQ(complaint(), "the survey has 7 dots; expected 8 or more, not all in one plane");
}

TEST_F(Observe, SaysWhichCameraSeesNoDot) {
  use(test::painted_hall());
  guess();
  blacken(1);
  EXPECT_THAT(complaint(), HasSubstr("camera \"cam2\": no dot found in its pictures"));
}

TEST_F(Observe, SaysWhichCamerasAreExchanged) {
  use(test::painted_hall());
  guess();
  std::swap(inputs_[1].approximate, inputs_[3].approximate);
  EXPECT_THAT(complaint(), HasSubstr("camera \"cam2\": its pictures do not fit its approximate "
                                     "model, but that of camera \"cam4\"; the two seem exchanged"));
}

TEST_F(Observe, SaysWhichCamerasAreExchangedBeforeAPlate) {
  use(test::painted_plate());
  guess();
  std::swap(inputs_[0].approximate, inputs_[1].approximate);
  EXPECT_THAT(complaint(), HasSubstr("exchanged"));
}

TEST_F(Observe, SaysThatTheUnitIsWrong) {
  use(test::painted_hall());
  guess();
  for (SurveyedDot& dot : hall_.dots) dot.position_m *= 1e-3;
  EXPECT_THAT(complaint(), HasSubstr("only if the survey is multiplied by 1000"));
}

TEST_F(Observe, SaysThatAPlatesUnitIsWrong) {
  use(test::painted_plate());
  for (SurveyedDot& dot : hall_.dots) {
    dot.position_m *= 1e3;
    dot.diameter_m = 0.0;
  }
  EXPECT_THAT(complaint(), HasSubstr("m away; the survey's unit is probably not"));
}

TEST_F(Observe, SaysThatDiametersAndCoordinatesAreOfDifferentUnits) {
  use(test::painted_plate());
  for (SurveyedDot& dot : hall_.dots) dot.position_m *= 10.0;
  EXPECT_NE(complaint(), "none");
}

TEST_F(Observe, SaysWhichAxisIsMirrored) {
  use(test::painted_hall());
  guess();
  for (SurveyedDot& dot : hall_.dots) dot.position_m.y() = -dot.position_m.y();
  EXPECT_THAT(complaint(), HasSubstr("only in a mirror; the coordinates are left-handed: change "
                                     "the sign of y in the survey"));
}

TEST_F(Observe, SaysThatAPlateIsMirrored) {
  use(test::painted_plate());
  for (SurveyedDot& dot : hall_.dots) {
    dot.position_m.z() = -dot.position_m.z();
    dot.normal.reset();
  }
  EXPECT_THAT(complaint(), HasSubstr("only in a mirror"));
}

}  // namespace
}  // namespace dottrack::calibrate
