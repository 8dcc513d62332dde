// What a camera file may look like, and what becomes of it.

#include "app/config/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/config/camera_internal.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/geometry/random_cameras.h"

namespace dottrack::config {
namespace {

using geometry::Cahv;
using geometry::Cahvor;
using geometry::Cahvore;
using testing::HasSubstr;

const std::string kCahv =
    "# looks along +z\n\nModel = CAHV = perspective, linear\n\nDimensions = 640 480\n\n"
    "C = 1 2 3\nA = 0 0 1\nH = 500 0 320\nV = 0 510 240\n";
const std::string kOr = "O = 0 0.6 0.8\nR = 0.001 -0.02 0.003\n";
const std::string kE = "E = 1e-3 -2e-4 3e-5\n";

std::string with_model(const std::string& model, const std::string& more) {
  std::string text = kCahv + more;
  text.replace(text.find("CAHV = perspective, linear"), 26, model);
  return text;
}

CameraFile parsed(const std::string& text) {
  auto file = parse_camera_text(text, "cam.txt");
  EXPECT_TRUE(file.has_value()) << file.error().message << "\n" << text;
  return file.value_or(CameraFile{});
}

TEST(CameraFileReader, ReadsCahv) {
  const CameraFile file = parsed(kCahv);
  const auto& m = std::get<Cahv>(file.model);
  EXPECT_EQ(m.c, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(m.a, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(m.h, Eigen::Vector3d(500, 0, 320));
  EXPECT_EQ(m.v, Eigen::Vector3d(0, 510, 240));
  ASSERT_TRUE(file.dimensions.has_value());
  EXPECT_EQ(file.dimensions->columns, 640);
  EXPECT_EQ(file.dimensions->rows, 480);
  EXPECT_EQ(file.comment, "looks along +z");
  EXPECT_FALSE(file.covariance.has_value());
}

TEST(CameraFileReader, ReadsCahvor) {
  const auto m = std::get<Cahvor>(parsed(with_model("CAHVOR = any words", kOr)).model);
  EXPECT_EQ(m.o, Eigen::Vector3d(0, 0.6, 0.8));
  EXPECT_EQ(m.r, Eigen::Vector3d(0.001, -0.02, 0.003));
}

TEST(CameraFileReader, ReadsTheThreeKindsOfCahvore) {
  const auto linearity = [](const std::string& model) {
    const auto m = std::get<Cahvore>(parsed(with_model(model, kOr + kE)).model);
    EXPECT_EQ(m.e, Eigen::Vector3d(1e-3, -2e-4, 3e-5));
    return m.linearity;
  };
  EXPECT_EQ(linearity("CAHVORE1 = perspective, distortion, pupil"), 1.0);
  EXPECT_EQ(linearity("CAHVORE2 = fish-eye"), 0.0);
  EXPECT_EQ(linearity("CAHVORE3,0.37 = general"), 0.37);
  EXPECT_EQ(linearity("CAHVORE3, -0.5"), -0.5);
  EXPECT_EQ(linearity("CAHVORE3 ,\t0.37= general"), 0.37);
}

TEST(CameraFileReader, TakesTheClassFromTheKeysWithoutAModelLine) {
  const std::string bare = "C = 1 2 3\nA = 0 0 1\nH = 500 0 320\nV = 0 510 240\n";
  EXPECT_TRUE(std::holds_alternative<Cahv>(parsed(bare).model));
  EXPECT_TRUE(std::holds_alternative<Cahvor>(parsed(bare + kOr).model));
  EXPECT_FALSE(parsed(bare).dimensions.has_value());
}

TEST(CameraFileReader, DoesNotMindOrderBlanksOrLineEnds) {
  const CameraFile file = parsed(
      "\xEF\xBB\xBF V= 0\t+510 2.4E2\r\n\tH =5e2 0 320\r\n\r\nA =0 0 1 # the axis\r\n"
      "C=1   2 3\r\nDimensions=640\t480\r\n# last\r\nModel=CAHV");
  const auto& m = std::get<Cahv>(file.model);
  EXPECT_EQ(m.h, Eigen::Vector3d(500, 0, 320));
  EXPECT_EQ(m.v, Eigen::Vector3d(0, 510, 240));
  EXPECT_EQ(file.comment, "last");
}

TEST(CameraFileReader, TakesAFirstLineWithoutAKeyForAComment) {
  EXPECT_EQ(parsed("Left of the door, 3 m up\n" + kCahv.substr(kCahv.find("Model"))).comment,
            "Left of the door, 3 m up");
}

TEST(CameraFileReader, NormalisesNothing) {
  std::string text = kCahv;
  text.replace(text.find("A = 0 0 1"), 9, "A = 0 0 1.0009");
  EXPECT_EQ(std::get<Cahv>(parsed(text).model).a, Eigen::Vector3d(0, 0, 1.0009));
}

TEST(CameraFileReader, AcceptsAMirroredImage) {
  std::string text = kCahv + "Theta = 1.570796327 (90.000000 deg)\n";
  text.replace(text.find("H = 500"), 7, "H = -500");
  const auto m = std::get<Cahv>(parsed(text).model);
  EXPECT_GT(internal_model(m.a, m.h, m.v).theta, 1.5);
}

TEST(CameraFileReader, ReadsInternalPartsNearWhatTheVectorsSay) {
  parsed(kCahv + "Hs    = 500\nHc =   320.05\nVs    = 509.8\nVc\t= 240\n" +
         "Theta = -1.5709 (-90.0 deg)\nS internal =\n" +
         "1 0 0 0 0\n0 1 0 0 0\n0 0 1 0 0\n0 0 0 1 0\n0 0 0 0 1\n");
}

TEST(CameraFileReader, ReadsCovariance) {
  std::string text = kCahv + "S =\n";
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) text += i == j ? " 4e-6" : j + i == 1 ? " 1e-6" : " 0";
    text += "\n";
  }
  const CameraFile file = parsed(text);
  ASSERT_TRUE(file.covariance.has_value());
  ASSERT_EQ(file.covariance->rows(), 12);
  ASSERT_EQ(file.covariance->cols(), 12);
  EXPECT_EQ((*file.covariance)(5, 5), 4e-6);
  EXPECT_EQ((*file.covariance)(0, 1), 1e-6);
  EXPECT_EQ((*file.covariance)(2, 3), 0.0);
}

TEST(CameraFileReader, ReadsAFileAndNamesAMissingOne) {
  const test::TemporaryFolder folder;
  const auto file = read_camera_file(folder.write("cam.cahv", kCahv));
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const auto missing = read_camera_file(folder.path() / "none.cahv");
  ASSERT_FALSE(missing.has_value());
  EXPECT_THAT(missing.error().message, HasSubstr("none.cahv: no such file"));
  const auto directory = read_camera_file(folder.path());
  ASSERT_FALSE(directory.has_value());
  EXPECT_THAT(directory.error().message, HasSubstr("is a folder"));
}

TEST(InternalModel, DerivativesMatchDifferences) {
  test::RandomCameras random(21);
  for (int i = 0; i < 200; ++i) {
    const Cahv m = random.cahv();
    const auto jacobian = internal_jacobian(m.a, m.h, m.v);
    for (int k = 0; k < 12; ++k) {
      const double step = k < 6 ? 1e-6 : 1e-3;
      const auto moved = [&](double by) {
        Eigen::Matrix<double, 12, 1> all;
        all << m.c, m.a, m.h, m.v;
        all[k] += by;
        const InternalModel im =
            internal_model(all.segment<3>(3), all.segment<3>(6), all.segment<3>(9));
        Eigen::Matrix<double, 5, 1> out;
        out << im.hs, im.hc, im.vs, im.vc, im.theta;
        return out;
      };
      const Eigen::Matrix<double, 5, 1> numeric = (moved(step) - moved(-step)) / (2.0 * step);
      ASSERT_LE((jacobian.col(k) - numeric).norm(), 1e-6 * (1.0 + numeric.norm())) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace dottrack::config
