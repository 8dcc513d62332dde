// Photographs of a real plate: from raw pixels, without labels, to models that are tested on dots
// they were not made from.

#include <gtest/gtest.h>

#include "app/workstation/calibrate/halves.h"
#include "app/workstation/calibrate/input/picture_folder.h"
#include "app/workstation/calibrate/input/survey_file.h"
#include "app/workstation/calibrate/labelling/observe.h"
#include "tests/support/shared_data.h"

namespace dottrack::calibrate {
namespace {

TEST(RealPlatePixels, ReachesThePlateInBothDirections) {
  const auto data = dottrack::test::shared_data();
  if (!data || !std::filesystem::is_directory(*data / "real_plate" / "myptv")) {
    GTEST_SKIP() << "shared data absent: real_plate";
  }
  const auto folder = *data / "real_plate" / "myptv";
  const auto dots = read_survey(folder / "dots3d.csv");
  const auto pictures = list_pictures(folder);
  ASSERT_TRUE(dots && pictures);
  std::vector<CameraInput> inputs;
  for (const CameraPictures& camera : *pictures) inputs.push_back({camera, {}, {}, {}});
  ASSERT_EQ(inputs.size(), 3U);
  const auto observed = observe(*dots, inputs);
  ASSERT_TRUE(observed) << observed.error().message;
  for (const CameraViews& camera : observed->views) EXPECT_GE(camera.observations.size(), 405U);
  for (const Half fit : {Half::even, Half::odd}) {
    const Half test = fit == Half::even ? Half::odd : Half::even;
    const auto calibration = calibrate(*dots, half_of(observed->views, fit));
    ASSERT_TRUE(calibration) << calibration.error().message;
    const HalfFigures figures = figures_of(*dots, observed->views, *calibration, test);
    EXPECT_GE(figures.observations, 620U);
    EXPECT_GE(figures.triangulated, 210U);
    EXPECT_LT(figures.rms_px, 0.26);
    EXPECT_LT(figures.rms_m, 0.053e-3);
  }
}

}  // namespace
}  // namespace dottrack::calibrate
