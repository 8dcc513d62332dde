// Files from elsewhere: written by JPL's library, varied in nineteen ways, found in the open.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "app/config/camera_file.h"
#include "app/config/camera_internal.h"
#include "tests/support/shared_data.h"
#include "tests/unit/geometry/table.h"

namespace dottrack::config {
namespace {

using test::Table;
using testing::HasSubstr;

struct Expectation {
  const char* class_name;  // or "" where the file is refused
  const char* where;       // of the refusal: ":line: " and some words
  const char* what;
};

constexpr Expectation accepted(const char* class_name) {
  return {class_name, "", ""};
}
constexpr Expectation refused(const char* where, const char* what) {
  return {"", where, what};
}

// 07, 09 and 21 are plain to read, though JPL's reader gives up on them; 11, 12, 23 and 26 are not.
const std::map<std::string, Expectation> kReaderCases = {
    {"01_as_written.cahvor", accepted("CAHVOR")},
    {"02_no_covariance_no_internal.cahvor", accepted("CAHVOR")},
    {"03_crlf.cahvor", accepted("CAHVOR")},
    {"04_comment_with_keys.cahvor", accepted("CAHVOR")},
    {"05_no_dimensions.cahvor", accepted("CAHVOR")},
    {"06_single_space_internal_keys.cahvor", accepted("CAHVOR")},
    {"07_no_space_before_equals.cahvor", accepted("CAHVOR")},
    {"08_tabs_short_model.cahvor", accepted("CAHVOR")},
    {"09_A_after_H.cahvor", accepted("CAHVOR")},
    {"10_exponents.cahvor", accepted("CAHVOR")},
    {"11_bad_number.cahvor", refused(":12: ", "R has \"nan_typo\"; expected a number")},
    {"12_truncated.cahvor", refused(":11: ", "O has 2 numbers; expected three")},
    {"20_as_written.cahvore", accepted("CAHVORE")},
    {"21_dimensions_before_model.cahvore", accepted("CAHVORE")},
    {"22_space_after_comma.cahvore", accepted("CAHVORE")},
    {"23_type3_without_parameter.cahvore", refused(":3: ", "expected CAHVORE3,P")},
    {"24_no_covariance.cahvore", accepted("CAHVORE")},
    {"25_type2.cahvore", accepted("CAHVORE")},
    {"26_E_missing.cahvore", refused(":3: ", "no key E in a CAHVORE file")}};

const std::map<std::string, Expectation> kExamples = {
    {"mrcal_overpass_cahv.cahvor", accepted("CAHV")},
    {"mrcal_overpass_cahv_cam1.cahvor", accepted("CAHV")},
    {"visionworkbench_minimal.cahvor", accepted("CAHVOR")},
    {"pds3_label_mer1_fhaz_cahvore.txt", refused(":1: ", "unknown key \"GROUP\"")},
    {"pds3_label_mer1_navcam_cahvor.txt", refused(":1: ", "unknown key \"GROUP\"")},
    {"pds3_label_mer1_pancam_cahvor.txt", refused(":1: ", "unknown key \"GROUP\"")},
    {"m2020_raw_feed_component_list.txt", refused(":1: ", "no key C")}};

// What the file must come to, as it is in models.csv.
void expect_vector(const Eigen::Vector3d& v, const Table& models, std::size_t row, char key) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(v[k], models.number(row, key + std::to_string(k))) << key << k;
  }
}

void expect_model(const geometry::CameraModel& model, const Table& models, std::size_t row) {
  const geometry::Cahv linear = linear_part(model);
  expect_vector(linear.c, models, row, 'c');
  expect_vector(linear.a, models, row, 'a');
  expect_vector(linear.h, models, row, 'h');
  expect_vector(linear.v, models, row, 'v');
  if (const auto* m = std::get_if<geometry::Cahvor>(&model)) {
    expect_vector(m->o, models, row, 'o');
    expect_vector(m->r, models, row, 'r');
  }
  if (const auto* m = std::get_if<geometry::Cahvore>(&model)) {
    expect_vector(m->o, models, row, 'o');
    expect_vector(m->r, models, row, 'r');
    expect_vector(m->e, models, row, 'e');
  }
}

class CameraFileExamples : public testing::Test {
 protected:
  void SetUp() override {
    const auto data = test::shared_data();
    if (!data) GTEST_SKIP() << "shared data absent: camera_models";
    folder_ = *data / "camera_models";
  }

  // Every file of the folder has its expectation, and meets it.
  void check_folder(const std::string& name, const std::map<std::string, Expectation>& expected) {
    std::size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / name)) {
      if (entry.path().extension() == ".csv") continue;
      SCOPED_TRACE(entry.path().filename().string());
      ++seen;
      check(entry.path(), expected.at(entry.path().filename().string()));
    }
    EXPECT_EQ(seen, expected.size());
  }

  static void check(const std::filesystem::path& path, const Expectation& expected) {
    const auto file = read_camera_file(path);
    if (*expected.class_name != '\0') {
      ASSERT_TRUE(file.has_value()) << file.error().message;
      EXPECT_EQ(geometry::class_name(file->model), expected.class_name);
    } else {
      ASSERT_FALSE(file.has_value());
      EXPECT_THAT(file.error().message, HasSubstr(path.string() + expected.where));
      EXPECT_THAT(file.error().message, HasSubstr(expected.what));
    }
  }

  std::filesystem::path folder_;
};

TEST_F(CameraFileExamples, ReaderCasesHaveTheirVerdicts) {
  check_folder("reader_cases", kReaderCases);
}

TEST_F(CameraFileExamples, FilesFoundInTheOpenHaveTheirVerdicts) {
  check_folder("examples", kExamples);
}

TEST_F(CameraFileExamples, AcceptedReaderCasesAreAllTheSameCamera) {
  const Table models = Table::read(folder_ / "models.csv");
  std::size_t checked = 0;
  for (const auto& [name, expected] : kReaderCases) {
    if (*expected.class_name == '\0') continue;
    SCOPED_TRACE(name);
    const auto file = read_camera_file(folder_ / "reader_cases" / name);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    const bool cahvore = std::holds_alternative<geometry::Cahvore>(file->model);
    const std::size_t row = cahvore ? 3 : 1;
    ASSERT_EQ(models.text(row, "model"),
              cahvore ? "cahvore_mer1_fhaz_left" : "cahvor_mer1_navcam_left");
    expect_model(file->model, models, row);
    EXPECT_EQ(file->dimensions.has_value(), name != "05_no_dimensions.cahvor");
    if (file->dimensions) {
      EXPECT_EQ(file->dimensions->columns, 1024);
    }
    if (cahvore) {
      EXPECT_EQ(std::get<geometry::Cahvore>(file->model).linearity,
                name == "25_type2.cahvore" ? 0.0 : 0.37);
    }
    ++checked;
  }
  EXPECT_EQ(checked, 15U);
}

TEST_F(CameraFileExamples, ModelsAreReadAsTheyAreListedAndWrittenBackExactly) {
  const Table models = Table::read(folder_ / "models.csv");
  ASSERT_EQ(models.size(), 5U);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::string name = models.text(i, "model");
    SCOPED_TRACE(name);
    const auto file =
        read_camera_file(folder_ / "models" / (name + "." + name.substr(0, name.find('_'))));
    ASSERT_TRUE(file.has_value()) << file.error().message;
    expect_model(file->model, models, i);
    const geometry::Cahv linear = linear_part(file->model);
    const InternalModel internal = internal_model(linear.a, linear.h, linear.v);
    EXPECT_NEAR(internal.hs, models.number(i, "hs"), 1e-9);
    EXPECT_NEAR(internal.hc, models.number(i, "hc"), 1e-9);
    EXPECT_NEAR(internal.vs, models.number(i, "vs"), 1e-9);
    EXPECT_NEAR(internal.vc, models.number(i, "vc"), 1e-9);
    EXPECT_NEAR(internal.theta, models.number(i, "theta"), 1e-12);
    ASSERT_TRUE(file->covariance.has_value());
    EXPECT_TRUE(file->covariance->isZero(0.0));
    const auto again = parse_camera_text(write_camera_text(*file), "again");
    ASSERT_TRUE(again.has_value()) << again.error().message;
    expect_model(again->model, models, i);
    EXPECT_EQ(again->comment, file->comment);
  }
}

}  // namespace
}  // namespace dottrack::config
