// Every way in which a camera file is refused: one line that names file, line and expectation.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/config/camera_file.h"

namespace dottrack::config {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Line numbers:        1
const std::string kFile =
    "# test\n"                                  // 1
    "Model = CAHVORE3,0.37 = general\n"         // 2
    "Dimensions = 640 480\n"                    // 3
    "C = 1 2 3\n"                               // 4
    "A = 0 0 1\n"                               // 5
    "H = 500 0 320\n"                           // 6
    "V = 0 510 240\n"                           // 7
    "O = 0 0.6 0.8\n"                           // 8
    "R = 0.001 -0.02 0.003\n"                   // 9
    "E = 0.001 0 0\n"                           // 10
    "Hs    = 500\n"                             // 11
    "Hc    = 320\n"                             // 12
    "Vs    = 510\n"                             // 13
    "Vc    = 240\n"                             // 14
    "Theta = -1.570796327 (-90.000000 deg)\n";  // 15

// kFile with one passage replaced, and where and how that is refused.
struct Refusal {
  const char* name;
  const char* from;
  const char* to;
  const char* where;  // file:line:
  const char* what;   // some words of the message
};

std::string changed(const Refusal& r) {
  std::string text = kFile;
  const auto at = text.find(r.from);
  EXPECT_NE(at, std::string::npos) << r.from;
  return text.replace(at, std::string(r.from).size(), r.to);
}

std::string complaint_about(const std::string& text) {
  const auto file = parse_camera_text(text, "cam.txt");
  return file ? "accepted" : file.error().message;
}

class CameraFileRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(CameraFileRefusals, NameFileLineAndExpectation) {
  ASSERT_EQ(complaint_about(kFile), "accepted");
  const std::string message = complaint_about(changed(GetParam()));
  EXPECT_THAT(message, StartsWith(std::string("cam.txt:") + GetParam().where + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().what));
  EXPECT_THAT(message, HasSubstr("; expected "));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Files, CameraFileRefusals,
    testing::Values(
        Refusal{"nan_typo", "-0.02", "nan_typo", "9", "R has \"nan_typo\""},
        Refusal{"nan", "-0.02", "nan", "9", "\"nan\""},
        Refusal{"infinity", "1 2 3", "1 -inf 3", "4", "\"-inf\""},
        Refusal{"too_large", "1 2 3", "1 2e999 3", "4", "2e999"},
        Refusal{"hexadecimal", "1 2 3", "1 0x2 3", "4", "0x2"},
        Refusal{"two_signs", "1 2 3", "1 +-2 3", "4", "+-2"},
        Refusal{"decimal_comma", "1 2 3", "1 2,5 3", "4", "2,5"},
        Refusal{"four_numbers", "1 2 3", "1 2 3 4", "4", "C has 4 numbers; expected three"},
        Refusal{"two_numbers", "1 2 3", "1 2", "4", "C has 2 numbers"},
        Refusal{"no_numbers", "C = 1 2 3", "C =", "4", "C has 0 numbers"},
        Refusal{"garbage", "1 2 3", "1 2 3 m", "4", "\"m\""},
        Refusal{"twice", "R = ", "O = 0 0 1\nR = ", "9", "key O again, first on line 8"},
        Refusal{"unknown_key", "R = ", "Q = 1\nR = ", "9", "unknown key \"Q\""},
        Refusal{"lower_case", "R = ", "r = ", "9", "unknown key \"r\""},
        Refusal{"no_equals", "R = ", "R ", "9", "expected a line like"},
        Refusal{"without_e", "E = 0.001 0 0\n", "", "2", "no key E in a CAHVORE file"},
        Refusal{"without_r", "R = 0.001 -0.02 0.003\n", "", "2", "no key R"},
        Refusal{"without_a", "A = 0 0 1\n", "", "2", "no key A"},
        Refusal{"cahv_with_o", "CAHVORE3,0.37", "CAHV", "8", "key O in a CAHV file"},
        Refusal{"cahvor_with_e", "CAHVORE3,0.37", "CAHVOR", "10", "key E in a CAHVOR file"},
        Refusal{"no_model", "Model = CAHVORE3,0.37 = general\n", "\n", "10", "no Model line"},
        Refusal{"no_parameter", "CAHVORE3,0.37", "CAHVORE3", "2", "linearity P as a number"},
        Refusal{"empty_parameter", "CAHVORE3,0.37", "CAHVORE3,", "2", "linearity P"},
        Refusal{"bad_parameter", "CAHVORE3,0.37", "CAHVORE3,wide", "2", "linearity P"},
        Refusal{"nan_parameter", "CAHVORE3,0.37", "CAHVORE3,nan", "2", "linearity P"},
        Refusal{"two_parameters", "CAHVORE3,0.37", "CAHVORE3,0.3 7", "2", "linearity P"},
        Refusal{"needless_parameter", "CAHVORE3,0.37", "CAHVORE2,0.37", "2", "Model is"},
        Refusal{"kindless", "CAHVORE3,0.37", "CAHVORE", "2", "Model is \"CAHVORE\""},
        Refusal{"other_model", "CAHVORE3,0.37", "PSPH", "2", "Model is \"PSPH\""},
        Refusal{"no_columns", "640 480", "0 480", "3", "Dimensions"},
        Refusal{"negative_rows", "640 480", "-1 -1", "3", "Dimensions"},
        Refusal{"half_a_pixel", "640 480", "640.5 480", "3", "Dimensions"},
        Refusal{"one_dimension", "640 480", "640", "3", "Dimensions"},
        Refusal{"three_dimensions", "640 480", "640 480 3", "3", "Dimensions"},
        Refusal{"huge_dimensions", "640 480", "640 99999999999", "3", "Dimensions"},
        Refusal{"long_a", "A = 0 0 1", "A = 0 0 1.002", "5", "A is a vector of length 1.002"},
        Refusal{"zero_a", "A = 0 0 1", "A = 0 0 0", "5", "A is a vector of length 0"},
        Refusal{"short_o", "O = 0 0.6 0.8", "O = 0 0.6 0.79", "8", "O is a vector of length"},
        Refusal{"flat", "V = 0 510 240", "V = 500 0 240", "7", "span an image"},
        Refusal{"other_hs", "Hs    = 500", "Hs    = 510", "11", "Hs is \"510\"; expected 500"},
        Refusal{"other_hc", "Hc    = 320", "Hc    = 310", "12", "Hc is \"310\""},
        Refusal{"other_vs", "Vs    = 510", "Vs    = nan", "13", "\"nan\""},
        Refusal{"other_vc", "Vc    = 240", "Vc    = 240 1", "14", "Vc is \"240 1\""},
        Refusal{"mirrored_theta", "-1.570796327 (-90", "1.570796327 (90", "15", "Theta is"},
        Refusal{"theta_in_degrees", "-1.570796327", "-90", "15", "Theta is"},
        Refusal{"other_degrees", "(-90.0", "(-80.0", "15", "Theta is"},
        Refusal{"no_unit", " deg)", ")", "15", "Theta is"}),
    [](const auto& tested) { return std::string(tested.param.name); });

// The covariance of a CAHVORE file: 21 x 21 of which one element may be changed.
std::string with_covariance(int rows, int columns, int i = -1, int j = -1,
                            const std::string& element = "") {
  std::string text = kFile + "S =\n";  // line 16
  for (int a = 0; a < rows; ++a) {
    for (int b = 0; b < columns; ++b) {
      text += a == i && b == j ? element : a == b ? "1e-6" : "1e-8";
      text += b + 1 < columns ? " " : "\n";
    }
  }
  return text;
}

TEST(CovarianceRefusals, NameLineAndExpectation) {
  EXPECT_EQ(complaint_about(with_covariance(21, 21)), "accepted");
  EXPECT_THAT(complaint_about(with_covariance(18, 18)),
              StartsWith("cam.txt:16: S has 18 rows; expected 21 rows of 21 numbers"));
  EXPECT_THAT(complaint_about(with_covariance(22, 21)), StartsWith("cam.txt:16: S has 22 rows"));
  EXPECT_THAT(complaint_about(with_covariance(21, 20)),
              StartsWith("cam.txt:17: row 1 of S has 20 numbers; expected 21"));
  EXPECT_THAT(complaint_about(with_covariance(21, 21, 4, 4, "-1e-6")),
              StartsWith("cam.txt:21: S(5,5) is -1e-06; expected a variance"));
  EXPECT_THAT(complaint_about(with_covariance(21, 21, 4, 2, "2e-8")),
              StartsWith("cam.txt:21: S(5,3) is 2e-08, S(3,5) is 1e-08; expected a symmetric"));
  EXPECT_THAT(complaint_about(with_covariance(21, 21, 20, 3, "nan")),
              StartsWith("cam.txt:37: S has \"nan\"; expected a number"));
  EXPECT_THAT(complaint_about(kFile + "S = 1 2 3\n"), StartsWith("cam.txt:16: S = 1 2 3"));
  EXPECT_THAT(complaint_about(kFile + "S internal =\n1 2 3\n"),
              StartsWith("cam.txt:16: S internal has 1 rows; expected 5 rows of 5"));
  EXPECT_THAT(complaint_about(with_covariance(21, 21) + "stray words\n"),
              StartsWith("cam.txt:16: S has 22 rows"));
}

TEST(CameraFileRefusal, OfAnEmptyFileNamesItsFirstLine) {
  EXPECT_THAT(complaint_about(""), StartsWith("cam.txt:1: no key C"));
  EXPECT_THAT(complaint_about("# only words\n\n"), StartsWith("cam.txt:2: no key C"));
}

// The vectors of a truncated file are never made up: up to its last number it is refused.
TEST(CameraFileRefusal, OfEveryTruncation) {
  const std::string vectors = kFile.substr(0, kFile.find("Hs"));
  const std::size_t last_number = vectors.rfind(' ') + 1;
  for (std::size_t length = 0; length <= last_number; ++length) {
    EXPECT_THAT(complaint_about(vectors.substr(0, length)), StartsWith("cam.txt:"))
        << vectors.substr(0, length);
  }
}

// Damaged files get one line or are read; nothing else happens.
TEST(CameraFileRefusal, OfRandomDamageIsOneLine) {
  std::mt19937 generator(3);
  const std::string text = with_covariance(21, 21);
  std::size_t refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = text;
    for (int k = 0; k < 3; ++k) {
      damaged[generator() % damaged.size()] = static_cast<char>(generator() % 256U);
    }
    const std::string message = complaint_about(damaged);
    if (message == "accepted") continue;
    ++refused;
    ASSERT_THAT(message, StartsWith("cam.txt:"));
    ASSERT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
  }
  EXPECT_GE(refused, 2000U);
}

}  // namespace
}  // namespace dottrack::config
