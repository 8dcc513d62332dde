// One mistake in a good rig file each: the message in full, without the folder.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::kGoodTarget;
using test::model_text;
using test::replaced;
using test::RigFolder;

class RigFileRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(RigFileRefuses, WithOneLine) {
  const RigFolder folder;
  folder.write("rig.toml", replaced(kGoodRig, GetParam().from, GetParam().to));
  EXPECT_EQ(complaint_about(folder), GetParam().message);
}

const std::string kRateWords = "; expected a number of hertz above 0 and up to 1000";
const std::string kDistanceWords =
    "; expected two numbers of metres, 0 < nearest < farthest <= 1000";
const std::string kIntensityWords =
    "; expected two whole numbers, 0 <= darkest <= brightest <= 255";
const std::string kContrastWords = "; expected a whole number from 0 to 254";
const std::string kBackgroundWords = "; expected an odd whole number from 3 to 255";
const std::string kStepWords = "; expected a number of metres above 0 and up to 100";
const std::string kResidualWords = "; expected a number of metres above 0 and up to 10";
const std::string kLostWords = "; expected a whole number from 1 to 1000000";
const std::string kNameWords = "; expected a folder's name of letters, digits, - and _";
const std::string kCameraKeys =
    "; expected one of name, model, distance_m, intensity_dn, min_contrast_dn, "
    "min_contrast_part, background_px, "
    "polarity, device, exposure_ms, gain, stamp_offset_ms, iris";

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, RigFileRefuses,
    testing::Values(
        Mistake{"AtTheTop", "[tracking]", "[trackin]",
                "rig.toml:27: unknown key \"trackin\" in the rig file; "
                "expected one of rig, camera, target, vehicle, tracking, can, trigger, lamp, "
                "light, loop, "
                "recording"},
        Mistake{"BeforeTheFirstTable", "[rig]", "name = 1\n[rig]",
                "rig.toml:1: unknown key \"name\" in the rig file; "
                "expected one of rig, camera, target, vehicle, tracking, can, trigger, lamp, "
                "light, loop, "
                "recording"},
        Mistake{"InRig", "frame_rate_hz", "fps",
                "rig.toml:3: unknown key \"fps\" in [rig]; expected one of name, frame_rate_hz, "
                "joint_covariance"},
        Mistake{"InCamera", "model", "modell",
                "rig.toml:7: unknown key \"modell\" in [[camera]]" + kCameraKeys},
        Mistake{"TheFirstOfTwoIsNamed", "distance_m = [2.0, 14.0]\nintensity_dn",
                "z_distance = 1\na_intensity",
                "rig.toml:8: unknown key \"z_distance\" in [[camera]]" + kCameraKeys},
        Mistake{"InTarget", "max_step_m", "max_step",
                "rig.toml:25: unknown key \"max_step\" in [target]; "
                "expected one of name, dots, upright, max_step_m, dot_sigma_m, allow_ambiguous"},
        Mistake{"InTracking", "lost_after_ticks", "lost_after",
                "rig.toml:29: unknown key \"lost_after\" in [tracking]; "
                "expected one of max_rms_residual_m, lost_after_ticks, "
                "max_false_lock_probability, watch_every_ticks, coast_ms"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    FrameRate, RigFileRefuses,
    testing::Values(
        Mistake{"Zero", "25.0", "0", "rig.toml:3: frame_rate_hz is 0" + kRateWords},
        Mistake{"Negative", "25.0", "-25.0", "rig.toml:3: frame_rate_hz is -25" + kRateWords},
        Mistake{"TooHigh", "25.0", "1000.1", "rig.toml:3: frame_rate_hz is 1000.1" + kRateWords},
        Mistake{"NaN", "25.0", "nan", "rig.toml:3: frame_rate_hz is nan" + kRateWords},
        Mistake{"Infinite", "25.0", "inf", "rig.toml:3: frame_rate_hz is inf" + kRateWords},
        Mistake{"Text", "25.0", "\"25\"", "rig.toml:3: frame_rate_hz is a text" + kRateWords}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Camera, RigFileRefuses,
    testing::Values(
        Mistake{"DuplicateName", "cam-2_b", "cam1",
                "rig.toml:15: name is \"cam1\" again, first on line 6; "
                "expected a name of its own for every camera"},
        Mistake{"NameWithSlash", "cam-2_b", "../b", "rig.toml:15: name is \"../b\"" + kNameWords},
        Mistake{"NameWithSpace", "cam-2_b", "cam 2", "rig.toml:15: name is \"cam 2\"" + kNameWords},
        Mistake{"NameOfTwoLines", "cam-2_b", "a\\nb", "rig.toml:15: name is \"a?b\"" + kNameWords},
        Mistake{"EmptyName", "cam-2_b", "", "rig.toml:15: name is \"\"" + kNameWords},
        Mistake{"NameIsNumber", "\"cam1\"", "1",
                "rig.toml:6: name is a whole number; expected a text"},
        Mistake{"NoName", "name = \"cam1\"\n", "",
                "rig.toml:5: [[camera]] has no key \"name\"; expected a text"},
        Mistake{"NoModel", "model = \"cam1.cahv\"\n", "",
                "rig.toml:5: [[camera]] has no key \"model\"; expected a text"},
        Mistake{"ModelMissing", "cam1.cahv", "cam9.cahv",
                "rig.toml:7: model is \"cam9.cahv\": no such file; "
                "expected a camera model file, relative to the rig file"},
        Mistake{"ModelIsFolder", "cam1.cahv", "models",
                "rig.toml:7: model is \"models\": is a folder; "
                "expected a camera model file, relative to the rig file"},
        Mistake{"DeviceIsList", "\"/base/i2c/imx296@1\"", "[]",
                "rig.toml:17: device is a list; expected a text"},
        Mistake{"PolarityUnknown", "\"dark\"", "\"black\"",
                "rig.toml:12: polarity is \"black\"; expected bright or dark"},
        Mistake{"EveryPixelIsADot", "min_contrast_dn = 8", "min_contrast_dn = 0",
                "rig.toml:14: this camera takes every pixel for a dot's; "
                "expected intensity_dn narrower than [0, 255], or min_contrast_dn or "
                "min_contrast_part above 0"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Distance, RigFileRefuses,
    testing::Values(Mistake{"Missing", "distance_m = [2.0, 14.0]\n", "",
                            "rig.toml:5: [[camera]] has no key \"distance_m\"" + kDistanceWords},
                    Mistake{"Reversed", "[2.0, 14.0]", "[14.0, 2.0]",
                            "rig.toml:8: distance_m is [14, 2]" + kDistanceWords},
                    Mistake{"Equal", "[2.0, 14.0]", "[2.0, 2.0]",
                            "rig.toml:8: distance_m is [2, 2]" + kDistanceWords},
                    Mistake{"FromZero", "[2.0, 14.0]", "[0.0, 14.0]",
                            "rig.toml:8: distance_m is [0, 14]" + kDistanceWords},
                    Mistake{"InMillimetres", "[2.0, 14.0]", "[2000, 14000]",
                            "rig.toml:8: distance_m is [2000, 14000]" + kDistanceWords},
                    Mistake{"NaN", "[2.0, 14.0]", "[nan, 14.0]",
                            "rig.toml:8: distance_m is [nan, 14]" + kDistanceWords},
                    Mistake{"Infinite", "[2.0, 14.0]", "[2.0, inf]",
                            "rig.toml:8: distance_m is [2, inf]" + kDistanceWords},
                    Mistake{"OneNumber", "[2.0, 14.0]", "14.0",
                            "rig.toml:8: distance_m is a number" + kDistanceWords},
                    Mistake{"ThreeNumbers", "[2.0, 14.0]", "[1, 2, 3]",
                            "rig.toml:8: distance_m is a list of 3" + kDistanceWords},
                    Mistake{"Texts", "[2.0, 14.0]", "[\"2\", \"14\"]",
                            "rig.toml:8: distance_m is not a list of numbers" + kDistanceWords}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Brightness, RigFileRefuses,
    testing::Values(
        Mistake{"IntensityReversed", "[128, 250]", "[250, 128]",
                "rig.toml:9: intensity_dn is [250, 128]" + kIntensityWords},
        Mistake{"IntensityTooHigh", "[128, 250]", "[128, 256]",
                "rig.toml:9: intensity_dn is [128, 256]" + kIntensityWords},
        Mistake{"IntensityNegative", "[128, 250]", "[-1, 250]",
                "rig.toml:9: intensity_dn is [-1, 250]" + kIntensityWords},
        Mistake{"IntensityFractions", "[128, 250]", "[0.5, 1.0]",
                "rig.toml:9: intensity_dn is not a list of whole numbers" + kIntensityWords},
        Mistake{"IntensityOneNumber", "[128, 250]", "128",
                "rig.toml:9: intensity_dn is a whole number" + kIntensityWords},
        Mistake{"ContrastNegative", "min_contrast_dn = 9", "min_contrast_dn = -1",
                "rig.toml:10: min_contrast_dn is -1" + kContrastWords},
        Mistake{"ContrastTooHigh", "min_contrast_dn = 9", "min_contrast_dn = 255",
                "rig.toml:10: min_contrast_dn is 255" + kContrastWords},
        Mistake{"ContrastPartNegative", "min_contrast_dn = 9", "min_contrast_part = -0.1",
                "rig.toml:10: min_contrast_part is -0.1; expected a number from 0 to 4"},
        Mistake{"ContrastFraction", "min_contrast_dn = 9", "min_contrast_dn = 8.5",
                "rig.toml:10: min_contrast_dn is a number" + kContrastWords},
        Mistake{"ContrastBeyondEveryInteger", "min_contrast_dn = 9", "min_contrast_dn = 4294967304",
                "rig.toml:10: min_contrast_dn is 4294967304" + kContrastWords},
        Mistake{"BackgroundEven", "background_px = 31", "background_px = 20",
                "rig.toml:11: background_px is 20" + kBackgroundWords},
        Mistake{"BackgroundTooNarrow", "background_px = 31", "background_px = 1",
                "rig.toml:11: background_px is 1" + kBackgroundWords},
        Mistake{"BackgroundTooWide", "background_px = 31", "background_px = 257",
                "rig.toml:11: background_px is 257" + kBackgroundWords}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    TargetAndTracking, RigFileRefuses,
    testing::Values(Mistake{"NoTarget",
                            "[target]\nname = \"rover\"\ndots = \"target.csv\"\nupright = false\n"
                            "max_step_m = 0.3\n",
                            "",
                            "rig.toml:1: no table [target]; expected a table [target], or up to 8 "
                            "tables [[target]]"},
                    Mistake{"NoDots", "dots = \"target.csv\"\n", "",
                            "rig.toml:21: [target] has no key \"dots\"; expected a text"},
                    Mistake{"DotsMissing", "target.csv", "rover.csv",
                            "rig.toml:23: dots is \"rover.csv\": no such file; "
                            "expected a target file, relative to the rig file"},
                    Mistake{"UprightIsNumber", "upright = false", "upright = 0",
                            "rig.toml:24: upright is a whole number; expected true or false"},
                    Mistake{"StepZero", "max_step_m = 0.3", "max_step_m = 0.0",
                            "rig.toml:25: max_step_m is 0" + kStepWords},
                    Mistake{"StepNaN", "max_step_m = 0.3", "max_step_m = nan",
                            "rig.toml:25: max_step_m is nan" + kStepWords},
                    Mistake{"StepInMillimetres", "max_step_m = 0.3", "max_step_m = 300",
                            "rig.toml:25: max_step_m is 300" + kStepWords},
                    Mistake{"ResidualZero", "max_rms_residual_m = 0.01", "max_rms_residual_m = 0",
                            "rig.toml:28: max_rms_residual_m is 0" + kResidualWords},
                    Mistake{"ResidualInMillimetres", "max_rms_residual_m = 0.01",
                            "max_rms_residual_m = 20",
                            "rig.toml:28: max_rms_residual_m is 20" + kResidualWords},
                    Mistake{"LostAfterZero", "lost_after_ticks = 7", "lost_after_ticks = 0",
                            "rig.toml:29: lost_after_ticks is 0" + kLostWords},
                    Mistake{"LostAfterIsDate", "lost_after_ticks = 7",
                            "lost_after_ticks = 2020-01-01",
                            "rig.toml:29: lost_after_ticks is a date or time" + kLostWords}),
    name_of);

TEST(RigFileRefusesFiles, NoRigFile) {
  const RigFolder folder;
  std::filesystem::remove(folder.rig());
  EXPECT_EQ(complaint_about(folder), "rig.toml: no such file; expected a rig file");
}

TEST(RigFileRefusesFiles, FolderForRigFile) {
  const RigFolder folder;
  std::filesystem::remove(folder.rig());
  std::filesystem::create_directory(folder.rig());
  EXPECT_EQ(complaint_about(folder), "rig.toml: is a folder; expected a rig file");
}

TEST(RigFileRefusesFiles, MoreThanAMebibyte) {
  const RigFolder folder;
  folder.write("rig.toml", std::string((1U << 20U) + 1U, '#'));
  EXPECT_EQ(complaint_about(folder), "rig.toml: is larger than 1 MiB; expected a rig file");
}

TEST(RigFileRefusesFiles, EmptyRigFile) {
  const RigFolder folder;
  folder.write("rig.toml", "");
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:1: no table [[camera]]; expected 2 to 16 tables [[camera]]");
}

TEST(RigFileRefusesFiles, NotToml) {
  const RigFolder folder;
  folder.write("rig.toml", "[rig]\nname = sandbox\n");
  const std::string message = complaint_about(folder);
  EXPECT_EQ(message.substr(0, 11), "rig.toml:2:") << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(RigFileRefusesFiles, ImageForRigFile) {
  const RigFolder folder;
  folder.write("rig.toml", std::string("P5\n4 4\n255\n\x01\x02\x00\xFF", 15));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:4: Encountered invalid utf-8 sequence; expected TOML");
}

TEST(RigFileRefusesFiles, ModelWithoutDimensions) {
  const RigFolder folder;
  folder.write("models/cam2.cahv", model_text(""));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:16: model \"models/cam2.cahv\" has no Dimensions; "
            "expected the image size, as in Dimensions = 640 480");
}

TEST(RigFileRefusesFiles, ModelTooLarge) {
  const RigFolder folder;
  folder.write("models/cam2.cahv", model_text("Dimensions = 2049 480\n"));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:16: model \"models/cam2.cahv\" is of 2049 x 480 pixels; "
            "expected up to 2048 x 2048");
}

TEST(RigFileRefusesFiles, ModelWithNaN) {
  const RigFolder folder;
  folder.write("cam1.cahv", replaced(model_text("Dimensions = 640 480\n"), "C = 2.0", "C = nan"));
  const std::string message = complaint_about(folder);
  EXPECT_EQ(message.substr(0, 12), "cam1.cahv:7:") << message;
}

TEST(RigFileRefusesFiles, BadTargetFileIsNamedItself) {
  const RigFolder folder;
  folder.write("target.csv", replaced(kGoodTarget, "2,0.0,0.7", "2,0.0,nan"));
  EXPECT_EQ(complaint_about(folder),
            "target.csv:4: y_m is \"nan\"; expected a number of metres from -100 to 100");
}

std::string rig_of_cameras(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "[[camera]]\nname = \"cam" + std::to_string(i) +
            "\"\nmodel = \"cam1.cahv\"\ndistance_m = [2, 14]\nmin_contrast_dn = 8\n";
  }
  return text + "[target]\ndots = \"target.csv\"\n";
}

TEST(RigFileRefusesCameras, Only1) {
  const RigFolder folder;
  folder.write("rig.toml", rig_of_cameras(1));
  EXPECT_EQ(complaint_about(folder), "rig.toml:1: 1 cameras; expected 2 to 16 tables [[camera]]");
}

TEST(RigFileRefusesCameras, None) {
  const RigFolder folder;
  folder.write("rig.toml", rig_of_cameras(0));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:1: no table [[camera]]; expected 2 to 16 tables [[camera]]");
}

TEST(RigFileRefusesCameras, MoreThan16AtTheSeventeenth) {
  const RigFolder folder;
  folder.write("rig.toml", rig_of_cameras(18));
  EXPECT_EQ(complaint_about(folder), "rig.toml:81: 18 cameras; expected 2 to 16 tables [[camera]]");
}

TEST(RigFileRefusesCameras, SingleBrackets) {
  const RigFolder folder;
  folder.write("rig.toml", "[camera]\nname = \"cam1\"\n");
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:1: camera is a table; expected 2 to 16 tables [[camera]]");
}

TEST(RigFileRefusesCameras, EmptyList) {
  const RigFolder folder;
  folder.write("rig.toml", "\ncamera = []\n");
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:2: camera is a list; expected 2 to 16 tables [[camera]]");
}

TEST(RigFileRefusesTables, RigIsText) {
  const RigFolder folder;
  folder.write("rig.toml", "\nrig = \"sandbox\"\n");
  EXPECT_EQ(complaint_about(folder), "rig.toml:2: rig is a text; expected a table [rig]");
}

}  // namespace
}  // namespace dottrack::config
