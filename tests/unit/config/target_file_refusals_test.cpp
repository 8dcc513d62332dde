// One mistake in a good target file each: the message in full.

#include <gtest/gtest.h>

#include <string>

#include "app/config/target_file.h"
#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::replaced;

constexpr std::string_view kTarget =
    "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz\n"  // 1
    "0,0.0,0.0,0.5,0.11,0,0,1\n"             // 2
    "# the other side\n"                     // 3
    "1,1.0,0.0,0.5,0.12,0,0,1\n"             // 4
    "2,0.0,0.7,0.6,0.13,0,0,1\n"             // 5
    "3,0.3,0.9,0.8,0.14,0,0,1\n";            // 6

std::string complaint_about(const std::string& text) {
  const Result<TargetFile> file = parse_target_text(text, "t.csv");
  return file ? "accepted" : file.error().message;
}

class TargetFileRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(TargetFileRefuses, WithOneLine) {
  EXPECT_EQ(complaint_about(replaced(kTarget, GetParam().from, GetParam().to)), GetParam().message);
}

const std::string kHeaders =
    "; expected dot,x_m,y_m,z_m,diameter_m or dot,x_m,y_m,z_m,diameter_m,nx,ny,nz";
const std::string kMetres = "; expected a number of metres from -100 to 100";
const std::string kDiameter = "; expected a number of metres above 0 and up to 10";
const std::string kUnit = "; expected a unit vector, within 0.001";
const std::string kNormal = "; expected a number: the normal is a unit vector, or left empty";

INSTANTIATE_TEST_SUITE_P(
    Lines, TargetFileRefuses,
    testing::Values(
        Mistake{"WrongHeader", "dot,x_m", "dot,x_mm",
                "t.csv:1: header \"dot,x_mm,y_m,z_m,diameter_m,nx,ny,nz\"" + kHeaders},
        Mistake{"NoHeader", "dot,x_m,y_m,z_m,diameter_m,nx,ny,nz\n", "",
                "t.csv:1: header \"0,0.0,0.0,0.5,0.11,0,0,1\"" + kHeaders},
        Mistake{"TooFewFields", "1,1.0,0.0,0.5,0.12,0,0,1", "1,1.0,0.0,0.5,0.12",
                "t.csv:4: 5 fields; expected 8 as in the header"},
        Mistake{"TooManyFields", "0.12,0,0,1", "0.12,0,0,1,",
                "t.csv:4: 9 fields; expected 8 as in the header"},
        Mistake{"Semicolons", "1,1.0,0.0,0.5,0.12,0,0,1", "1;1.0;0.0;0.5;0.12;0;0;1",
                "t.csv:4: 1 fields; expected 8 as in the header"},
        Mistake{"DuplicateDot", "2,0.0,0.7", "1,0.0,0.7",
                "t.csv:5: dot \"1\" again, first on line 4; expected every dot once"},
        Mistake{"NamelessDot", "2,0.0,0.7", ",0.0,0.7",
                "t.csv:5: a dot without a name in column dot; expected a name or a number"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Numbers, TargetFileRefuses,
    testing::Values(
        Mistake{"Words", "1,1.0", "1,one", "t.csv:4: x_m is \"one\"" + kMetres},
        Mistake{"TrailingUnit", "1,1.0", "1,1.0m", "t.csv:4: x_m is \"1.0m\"" + kMetres},
        Mistake{"Empty", "1,1.0,", "1,,", "t.csv:4: x_m is \"\"" + kMetres},
        Mistake{"NaN", "2,0.0,0.7", "2,0.0,NaN", "t.csv:5: y_m is \"NaN\"" + kMetres},
        Mistake{"Infinite", "0.7,0.6", "0.7,inf", "t.csv:5: z_m is \"inf\"" + kMetres},
        Mistake{"BeyondDouble", "0.7,0.6", "0.7,1e999", "t.csv:5: z_m is \"1e999\"" + kMetres},
        Mistake{"InMillimetres", "0.7,0.6", "700,0.6", "t.csv:5: y_m is 700" + kMetres},
        Mistake{"DiameterZero", "0.12", "0", "t.csv:4: diameter_m is 0" + kDiameter},
        Mistake{"DiameterNegative", "0.12", "-0.12", "t.csv:4: diameter_m is -0.12" + kDiameter},
        Mistake{"DiameterNaN", "0.12", "nan", "t.csv:4: diameter_m is \"nan\"" + kDiameter},
        Mistake{"DiameterInMillimetres", "0.12", "120", "t.csv:4: diameter_m is 120" + kDiameter}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Normals, TargetFileRefuses,
    testing::Values(
        Mistake{"Zero", "0.12,0,0,1", "0.12,0,0,0",
                "t.csv:4: nx,ny,nz is a vector of length 0" + kUnit},
        Mistake{"TooLong", "0.12,0,0,1", "0.12,0,0,1.0011",
                "t.csv:4: nx,ny,nz is a vector of length 1.001" + kUnit},
        Mistake{"NaN", "0.12,0,0,1", "0.12,0,nan,1", "t.csv:4: ny is \"nan\"" + kNormal},
        Mistake{"Infinite", "0.12,0,0,1", "0.12,0,0,-inf", "t.csv:4: nz is \"-inf\"" + kNormal},
        Mistake{"HalfEmpty", "0.12,0,0,1", "0.12,,,1", "t.csv:4: nx is \"\"" + kNormal}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Shape, TargetFileRefuses,
    testing::Values(
        Mistake{"Coincident", "2,0.0,0.7,0.6", "2,1.0,0.0,0.5",
                "t.csv:5: dot \"2\" coincides with dot \"1\"; expected dots at different places"},
        Mistake{"NearlyCoincident", "2,0.0,0.7,0.6", "2,1.0000005,0.0,0.5",
                "t.csv:5: dot \"2\" coincides with dot \"1\"; expected dots at different places"},
        Mistake{"Overlapping", "2,0.0,0.7,0.6", "2,1.1,0.0,0.5",
                "t.csv:5: dot \"2\" overlaps dot \"1\": 0.1 m apart; "
                "expected at least 0.125 m, half the sum of their diameters"}),
    name_of);

std::string rows(int count) {
  std::string text = "dot,x_m,y_m,z_m,diameter_m\n";
  for (int i = 0; i < count; ++i) {
    text += std::to_string(i) + "," + std::to_string(i) + "," + std::to_string(i * i % 7) +
            ",0.5,0.1\n";
  }
  return text;
}

TEST(TargetFileRefusesCounts, NoDots) {
  EXPECT_EQ(complaint_about(rows(0)), "t.csv:1: 0 dots; expected 3 to 16 dots");
}

TEST(TargetFileRefusesCounts, TwoDots) {
  EXPECT_EQ(complaint_about(rows(2)), "t.csv:3: 2 dots; expected 3 to 16 dots");
}

TEST(TargetFileRefusesCounts, SeventeenDots) {
  EXPECT_EQ(complaint_about(rows(17)), "t.csv:18: more than 16 dots; expected 3 to 16 dots");
}

TEST(TargetFileRefusesCounts, EmptyFile) {
  EXPECT_EQ(complaint_about(""), "t.csv: no header line; expected dot,x_m,y_m,z_m,diameter_m");
}

TEST(TargetFileRefusesLines, ThreeOnALine) {
  EXPECT_EQ(complaint_about("dot,x_m,y_m,z_m,diameter_m\n"
                            "0,0.1,0.1,0.1,0.01\n1,0.2,0.2,0.2,0.01\n2,0.7,0.7,0.7,0.01\n"),
            "t.csv:4: all dots lie on a line; "
            "expected a dot at least 0.01039 m off it, 1 % of its length");
}

TEST(TargetFileRefusesLines, FiveNearlyOnALine) {
  EXPECT_EQ(complaint_about("dot,x_m,y_m,z_m,diameter_m\n"
                            "0,0.5,0.004,0,0.01\n1,0,0,0,0.01\n2,1,0,0,0.01\n"
                            "3,0.25,0,-0.004,0.01\n4,0.75,0.009,0,0.01\n"),
            "t.csv:6: all dots lie on a line; "
            "expected a dot at least 0.01 m off it, 1 % of its length");
}

TEST(TargetFileRefusesFiles, NoSuchFile) {
  const test::TemporaryFolder folder;
  const Result<TargetFile> file = read_target_file(folder.path() / "none.csv");
  ASSERT_FALSE(file.has_value());
  EXPECT_EQ(file.error().message, (folder.path() / "none.csv").string() +
                                      ": no such file; expected a target file with the header "
                                      "dot,x_m,y_m,z_m,diameter_m");
}

}  // namespace
}  // namespace dottrack::config
