// What is written parses back to exactly the same numbers, and a reader that scans forward for
// JPL's keys, as JPL's own does, finds them all.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "app/config/camera_file.h"
#include "app/config/camera_internal.h"
#include "tests/unit/geometry/random_cameras.h"

namespace dottrack::config {
namespace {

using geometry::Cahv;
using geometry::Cahvor;
using geometry::Cahvore;
using test::RandomCameras;

geometry::CameraModel random_model(RandomCameras& random, int i) {
  switch (i % 5) {
    case 0:
      return random.cahv();
    case 1:
      return random.cahvor();
    case 2:
      return random.cahvore(1.0);
    case 3:
      return random.cahvore(0.0);
    default:
      return random.cahvore(random.between(-1.0, 1.0));
  }
}

// Symmetric, with elements of all magnitudes.
Eigen::MatrixXd random_covariance(RandomCameras& random, const geometry::CameraModel& model) {
  const int size = std::holds_alternative<Cahv>(model)     ? 12
                   : std::holds_alternative<Cahvor>(model) ? 18
                                                           : 21;
  Eigen::MatrixXd root(size, size);
  for (int k = 0; k < root.size(); ++k) {
    root(k) = random.between(-1.0, 1.0) * std::pow(10.0, random.between(-9.0, 0.0));
  }
  const Eigen::MatrixXd s = root * root.transpose();
  return 0.5 * (s + s.transpose());
}

// Bits, not values: -0 is not 0.
template <class Vector>
bool same_bits(const Vector& a, const Vector& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

bool same_model(const Cahv& a, const Cahv& b) {
  return same_bits(a.c, b.c) && same_bits(a.a, b.a) && same_bits(a.h, b.h) && same_bits(a.v, b.v);
}

bool same(const geometry::CameraModel& a, const geometry::CameraModel& b) {
  if (a.index() != b.index() || !same_model(linear_part(a), linear_part(b))) return false;
  if (const auto* m = std::get_if<Cahvor>(&a)) {
    const auto& n = std::get<Cahvor>(b);
    return same_bits(m->o, n.o) && same_bits(m->r, n.r);
  }
  if (const auto* m = std::get_if<Cahvore>(&a)) {
    const auto& n = std::get<Cahvore>(b);
    return same_bits(m->o, n.o) && same_bits(m->r, n.r) && same_bits(m->e, n.e) &&
           m->linearity == n.linearity;
  }
  return true;
}

TEST(CameraFileWriter, ParsesBackExactly) {
  RandomCameras random(31);
  for (int i = 0; i < 500; ++i) {
    CameraFile file;
    file.model = random_model(random, i);
    file.comment = i % 3 == 0 ? "" : " C = north, A = up  # 2";
    if (i % 2 == 0) file.dimensions = ImageSize{1 + i, 480};
    if (i % 4 < 2) file.covariance = random_covariance(random, file.model);
    const std::string text = write_camera_text(file);
    const auto again = parse_camera_text(text, "again");
    ASSERT_TRUE(again.has_value()) << again.error().message << "\n" << text;
    EXPECT_TRUE(same(again->model, file.model)) << text;
    EXPECT_EQ(again->comment, file.comment);
    ASSERT_EQ(again->dimensions.has_value(), file.dimensions.has_value());
    if (file.dimensions) {
      EXPECT_EQ(again->dimensions->columns, file.dimensions->columns);
    }
    ASSERT_EQ(again->covariance.has_value(), file.covariance.has_value());
    if (file.covariance) {
      EXPECT_TRUE(same_bits(*again->covariance, *file.covariance));
    }
    EXPECT_EQ(write_camera_text(*again), text);
  }
}

TEST(CameraFileWriter, KeepsExtremeNumbers) {
  CameraFile file;
  Cahvor m;
  m.c = {-0.0, 1e-300, -123456789.12345678};
  m.h = {std::nextafter(500.0, 501.0), 1.0 / 3.0, 320.0};
  m.v = {0.0, 500.0, std::numeric_limits<double>::epsilon()};
  m.r = {5e-324, 1e-7, -2.5e-10};
  file.model = m;
  const auto again = parse_camera_text(write_camera_text(file), "again");
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_TRUE(same(again->model, file.model));
}

TEST(CameraFileWriter, KeepsACommentOnOneLine) {
  CameraFile file;
  file.comment = "one\nC = 9 9 9\r\nthree";
  const auto again = parse_camera_text(write_camera_text(file), "again");
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again->comment, "one C = 9 9 9  three");
}

// As JPL's reader goes about it: forward to the next occurrence of a literal key, then numbers.
class ForwardScan {
 public:
  explicit ForwardScan(const std::string& text) : text_(text), at_(text.find('\n')) {}

  bool skip_past(const std::string& key) {
    const auto found = text_.find("\n" + key, at_);
    if (found == std::string::npos) return false;
    at_ = found + 1 + key.size();
    return true;
  }
  double number() {
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    EXPECT_NE(end, text_.c_str() + at_) << text_.substr(at_, 40);
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return value;
  }
  Eigen::Vector3d vector(const std::string& key) {
    EXPECT_TRUE(skip_past(key)) << key;
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }

 private:
  const std::string& text_;
  std::size_t at_;
};

TEST(CameraFileWriter, IsReadByAForwardScanForLiteralKeys) {
  RandomCameras random(33);
  const Cahvore m = random.cahvore(0.37);
  const Eigen::MatrixXd s = random_covariance(random, m);
  const std::string text = write_camera_text({m, ImageSize{640, 480}, "C = A = H = S =", s});
  ForwardScan scan(text);
  ASSERT_TRUE(scan.skip_past("Model = CAHVORE3,"));
  EXPECT_EQ(scan.number(), 0.37);
  ASSERT_TRUE(scan.skip_past("Dimensions ="));
  EXPECT_EQ(scan.number(), 640.0);
  EXPECT_EQ(scan.number(), 480.0);
  EXPECT_EQ(scan.vector("C ="), m.c);
  EXPECT_EQ(scan.vector("A ="), m.a);
  EXPECT_EQ(scan.vector("H ="), m.h);
  EXPECT_EQ(scan.vector("V ="), m.v);
  EXPECT_EQ(scan.vector("O ="), m.o);
  EXPECT_EQ(scan.vector("R ="), m.r);
  EXPECT_EQ(scan.vector("E ="), m.e);
  ASSERT_TRUE(scan.skip_past("S ="));
  for (int i = 0; i < 21; ++i) {
    for (int j = 0; j < 21; ++j) ASSERT_EQ(scan.number(), s(i, j));
  }
  const InternalModel internal = internal_model(m.a, m.h, m.v);
  ASSERT_TRUE(scan.skip_past("Hs    ="));
  EXPECT_EQ(scan.number(), internal.hs);
  ASSERT_TRUE(scan.skip_past("Hc    ="));
  EXPECT_EQ(scan.number(), internal.hc);
  ASSERT_TRUE(scan.skip_past("Vs    ="));
  EXPECT_EQ(scan.number(), internal.vs);
  ASSERT_TRUE(scan.skip_past("Vc    ="));
  EXPECT_EQ(scan.number(), internal.vc);
  ASSERT_TRUE(scan.skip_past("Theta ="));
  EXPECT_EQ(scan.number(), internal.theta);
  ASSERT_TRUE(scan.skip_past("S internal ="));
  const auto jacobian = internal_jacobian(m.a, m.h, m.v);
  const Eigen::MatrixXd expected = jacobian * s.topLeftCorner<12, 12>() * jacobian.transpose();
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) EXPECT_NEAR(scan.number(), expected(i, j), 1e-9 * expected.norm());
  }
}

TEST(CameraFileWriter, SpellsTheKindsAsJplDoes) {
  const auto model_line = [](const geometry::CameraModel& model) {
    const std::string text = write_camera_text({model, {}, "", {}});
    const auto at = text.find("Model");
    return text.substr(at, text.find('\n', at) - at);
  };
  RandomCameras random(34);
  EXPECT_EQ(model_line(random.cahv()), "Model = CAHV = perspective, linear");
  EXPECT_EQ(model_line(random.cahvor()), "Model = CAHVOR = perspective, distortion");
  EXPECT_EQ(model_line(random.cahvore(1.0)), "Model = CAHVORE1 = perspective, distortion, pupil");
  EXPECT_EQ(model_line(random.cahvore(0.0)), "Model = CAHVORE2 = fish-eye");
  EXPECT_EQ(model_line(random.cahvore(0.37)), "Model = CAHVORE3,0.37 = general");
}

}  // namespace
}  // namespace dottrack::config
