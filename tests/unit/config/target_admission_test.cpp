// A rig with a target that looks like itself is refused, or loads with a warning.

#include "app/config/target_admission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::replaced;
using test::RigFolder;
using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;

constexpr std::string_view kSquare =
    "dot,x_m,y_m,z_m,diameter_m\n"
    "front left,0.3,0.3,0.5,0.05\n"
    "rear left,-0.3,0.3,0.5,0.05\n"
    "rear right,-0.3,-0.3,0.5,0.05\n"
    "front right,0.3,-0.3,0.5,0.05\n";

// 14 m away a tenth of a pixel of 1/457 is 3.06 mm, and half as much again.
const std::string kSquareIsAmbiguous =
    "target.csv:2: the target looks like itself: dots \"front left\" \"rear left\" \"rear right\" "
    "\"front right\" taken for \"rear left\" \"rear right\" \"front right\" \"front left\", turned "
    "by 90 degrees, misfits by 0.0 mm RMS; expected 20.7 mm or more, with dots known to 4.6 mm: "
    "move dot \"front left\" by 42.7 mm to 0.3427,0.3000,0.5000";

RigConfig load_or_fail(const RigFolder& folder) {
  Result<RigConfig> config = load_rig(folder.rig());
  if (!config) throw std::runtime_error(config.error().message);
  return std::move(*config);
}

std::string upright_rig() {
  return replaced(kGoodRig, "upright = false", "upright = true");
}

TEST(TargetAdmission, AGoodTargetLoadsWithoutAWord) {
  EXPECT_THAT(load_or_fail(RigFolder()).warnings, IsEmpty());
}

TEST(TargetAdmission, ASymmetricTargetIsRefusedWithAMoveThatHelps) {
  const RigFolder folder;
  folder.write("rig.toml", upright_rig());
  folder.write("target.csv", kSquare);
  EXPECT_EQ(complaint_about(folder), kSquareIsAmbiguous + ", or set allow_ambiguous");
  folder.write("target.csv", replaced(kSquare, "left,0.3,0.3,0.5", "left,0.3427,0.3,0.5"));
  EXPECT_THAT(load_or_fail(folder).warnings, IsEmpty());
}

TEST(TargetAdmission, WhereItIsAllowedASymmetricTargetLoadsWithAWarning) {
  const RigFolder folder;
  folder.write("rig.toml",
               replaced(upright_rig(), "max_step_m", "allow_ambiguous = true\nmax_step_m"));
  folder.write("target.csv", kSquare);
  const RigConfig config = load_or_fail(folder);
  EXPECT_EQ(config.rig.target.dots.size(), 4U);
  EXPECT_THAT(config.warnings, ElementsAre(EndsWith(kSquareIsAmbiguous)));
}

TEST(TargetAdmission, NearerCamerasKnowBetter) {
  const RigFolder folder;
  folder.write("target.csv", replaced(kSquare, "left,0.3,0.3,0.5", "left,0.32,0.3,0.5"));
  folder.write("rig.toml", upright_rig());
  EXPECT_THAT(complaint_about(folder), testing::HasSubstr("the target looks like itself"));
  folder.write("rig.toml", replaced(upright_rig(), "[1, 9]", "[1, 4]"));
  EXPECT_THAT(complaint_about(folder), testing::HasSubstr("the target looks like itself"))
      << "the worse of two cameras counts";
  folder.write("rig.toml",
               replaced(replaced(upright_rig(), "[2.0, 14.0]", "[2.0, 4.0]"), "[1, 9]", "[1, 4]"));
  EXPECT_EQ(complaint_about(folder), "accepted");
}

TEST(TargetAdmission, AFewDotsThatCanBeMistakenAreAWarning) {
  const RigFolder folder;
  folder.write("rig.toml", upright_rig());
  folder.write("target.csv", std::string(kSquare) + "mast,0.11,0.05,0.9,0.05\n");
  EXPECT_THAT(
      load_or_fail(folder).warnings,
      ElementsAre(EndsWith(
          "target.csv: 4 of its 5 dots can be mistaken for others while no more are seen, with "
          "dots known to 4.6 mm: dots \"front left\" \"rear left\" \"rear right\" \"front right\" "
          "taken for \"rear left\" \"rear right\" \"front right\" \"front left\", turned by 90 "
          "degrees, misfits by 0.0 mm RMS")));
}

TEST(TargetAdmission, DotsThatTellTheAttitudeBadlyAreAWarning) {
  const RigFolder folder;
  folder.write("rig.toml", upright_rig());
  folder.write("target.csv",
               "dot,x_m,y_m,z_m,diameter_m\n"
               "0,0,0,0.5,0.05\n"
               "1,0.4,0.08,0.5,0.05\n"
               "2,1.1,0.0,0.5,0.05\n");
  EXPECT_THAT(load_or_fail(folder).warnings,
              ElementsAre(EndsWith(
                  "target.csv: its dots tell the attitude to 4.1 degrees only, with dots known to "
                  "4.6 mm; 2 or better takes dots farther apart, or farther from one line")));
}

}  // namespace
}  // namespace dottrack::config
