// What the cameras' models have in common: its file, and what a rig makes of it.

#include "app/config/joint_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "app/config/camera_file.h"
#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"

namespace dottrack::config {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using test::kGoodRig;
using test::model_text;
using test::replaced;
using test::RigFolder;

constexpr Index kNumbers = 12;

// Both cameras stand and look a little otherwise, by errors of their own and by common ones.
JointCovariance some_joint(double common) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const double sigmas[4] = {3e-4, 5e-5, 0.03, 0.03};
  MatrixXd own(2 * kNumbers, 2 * kNumbers);
  MatrixXd shared(2 * kNumbers, kNumbers);
  own.setZero();
  for (Index i = 0; i < 2 * kNumbers; ++i) {
    const double sigma = sigmas[i % kNumbers / 3];
    for (Index j = 0; j < kNumbers; ++j) {
      own(i, i / kNumbers * kNumbers + j) = sigma * normal(random);
      shared(i, j) = common * sigma * normal(random);
    }
  }
  JointCovariance joint;
  joint.cameras = {{"cam1", 0, kNumbers}, {"cam-2_b", kNumbers, kNumbers}};
  joint.covariance = own * own.transpose() + shared * shared.transpose();
  return joint;
}

class JointRig : public RigFolder {
 public:
  explicit JointRig(const JointCovariance& joint) {
    write_model("cam1.cahv", "Dimensions = 640 480\n", joint, 0);
    write_model("models/cam2.cahv", "Dimensions = 2048 2048\n", joint, 1);
    write("joint.csv", write_joint_covariance(joint));
    write("rig.toml", replaced(kGoodRig, "frame_rate_hz = 25.0\n",
                               "frame_rate_hz = 25.0\njoint_covariance = \"joint.csv\"\n"));
  }

  void write_model(const std::string& name, const std::string& size, const JointCovariance& joint,
                   std::size_t i) {
    auto camera = parse_camera_text(model_text(size), name);
    if (!camera) throw std::runtime_error(camera.error().message);
    camera->covariance = joint.block(joint.cameras[i], joint.cameras[i]);
    write(name, write_camera_text(*camera));
  }
};

TEST(JointCovariance, ReadsBackWhatWasWritten) {
  const JointCovariance joint = some_joint(1.0);
  const auto read = parse_joint_covariance(write_joint_covariance(joint), "joint.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->cameras.size(), 2U);
  EXPECT_EQ(read->cameras[1].name, "cam-2_b");
  EXPECT_EQ(read->cameras[1].first, kNumbers);
  EXPECT_LT((read->covariance - joint.covariance).norm(), 1e-9 * joint.covariance.norm());
}

struct Wrong {
  std::string text;
  std::string message;
};
class JointCovarianceRefuses : public testing::TestWithParam<Wrong> {};

TEST_P(JointCovarianceRefuses, WithOneLine) {
  const auto read = parse_joint_covariance(GetParam().text, "j.csv");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, GetParam().message);
}

const std::string kHead = "camera,row_up_to_the_diagonal\n";
const std::string kLength = "a row of another length; expected a camera's name and ";

INSTANTIATE_TEST_SUITE_P(
    Mistakes, JointCovarianceRefuses,
    testing::Values(
        Wrong{"", "j.csv: no camera; expected rows of numbers"},
        Wrong{"camera,row\n",
              "j.csv:1: header \"camera,row\"; expected camera,row_up_to_the_diagonal"},
        Wrong{kHead + "a,1\na,2\n", "j.csv:3: " + kLength + "2 numbers"},
        Wrong{kHead + "a,1\na,2,3,4\n", "j.csv:3: " + kLength + "2 numbers"},
        Wrong{kHead + "a\n", "j.csv:2: " + kLength + "1 numbers"},
        Wrong{kHead + "a,one\n", "j.csv:2: a covariance is \"one\"; expected a number"},
        Wrong{kHead + "a,nan\n", "j.csv:2: a covariance is \"nan\"; expected a number"},
        Wrong{kHead + "a,1\nb,0,1\n",
              "j.csv:3: 1 rows of camera \"a\"; expected 12, 18 or 21 rows: C A H V [O R [E]]"}));

TEST(JointCovariance, OfNoErrorsIsRefused) {
  JointCovariance joint = some_joint(1.0);
  const Index other = kNumbers + 3;
  joint.covariance(0, other) = joint.covariance(other, 0) =
      1.1 * std::sqrt(joint.covariance(0, 0) * joint.covariance(other, other));
  const auto read = parse_joint_covariance(write_joint_covariance(joint), "j.csv");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message,
            "j.csv:27: numbers that no errors can have together; expected a covariance, as "
            "dottrack calibrate wrote it");
}

// Each model error is one standard deviation: what the vectors have in common is the correlation.
TEST(JointCovariance, TellsHowTheModelsErrorsGoTogether) {
  const JointCovariance joint = some_joint(1.0);
  const JointRig folder(joint);
  const auto config = load_rig(folder.rig());
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_TRUE(config->warnings.empty());
  const core::Rig& rig = config->rig;
  ASSERT_TRUE(rig.model_correlations.known());
  const Eigen::Vector3d place(2.3, 1.2, 0.4);
  // Of the two cameras' pixels of one place: through the vectors, and through the errors.
  const auto jacobian = [&](const core::Camera& camera) {
    const geometry::Cahv model = std::get<geometry::Cahv>(camera.model);
    Eigen::Matrix<double, 2, kNumbers> j;
    for (Index i = 0; i < kNumbers; ++i) {
      geometry::Cahv more = model;
      geometry::Cahv less = model;
      Eigen::Vector3d* const up[4] = {&more.c, &more.a, &more.h, &more.v};
      Eigen::Vector3d* const down[4] = {&less.c, &less.a, &less.h, &less.v};
      (*up[i / 3])[i % 3] += 1e-5;
      (*down[i / 3])[i % 3] -= 1e-5;
      Eigen::Vector2d a;
      Eigen::Vector2d b;
      EXPECT_EQ(geometry::project(more, place, a), geometry::OpticsStatus::ok);
      EXPECT_EQ(geometry::project(less, place, b), geometry::OpticsStatus::ok);
      j.col(i) = (a - b) / 2e-5;
    }
    return j;
  };
  const auto shift = [&](std::size_t camera, std::size_t error) {
    Eigen::Vector2d right;
    Eigen::Vector2d wrong;
    EXPECT_EQ(geometry::project(rig.cameras[camera].model, place, right),
              geometry::OpticsStatus::ok);
    EXPECT_EQ(geometry::project(rig.cameras[camera].model_errors[error], place, wrong),
              geometry::OpticsStatus::ok);
    return Eigen::Vector2d(wrong - right);
  };
  const Eigen::Matrix2d truth = jacobian(rig.cameras[0]) *
                                joint.block(joint.cameras[0], joint.cameras[1]) *
                                jacobian(rig.cameras[1]).transpose();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < rig.cameras[0].model_errors.size(); ++i) {
    for (std::size_t j = 0; j < rig.cameras[1].model_errors.size(); ++j) {
      sum += rig.model_correlations({0, i}, {1, j}) * shift(0, i) * shift(1, j).transpose();
    }
  }
  EXPECT_GT(truth.norm(), 1e-3);
  EXPECT_LT((sum - truth).norm(), 0.03 * truth.norm());
}

TEST(JointCovariance, WhereNothingIsSharedNothingGoesTogether) {
  const JointRig folder(some_joint(0.0));
  const auto config = load_rig(folder.rig());
  ASSERT_TRUE(config) << config.error().message;
  for (std::size_t i = 0; i < config->rig.cameras[0].model_errors.size(); ++i) {
    EXPECT_EQ(config->rig.model_correlations({0, i}, {1, 0}), 0.0);
  }
}

// One camera was knocked and has another model now.
TEST(JointCovariance, WarnsOfAModelThatIsNotOfTheSameCalibration) {
  const JointCovariance joint = some_joint(1.0);
  JointRig folder(joint);
  JointCovariance anew = joint;
  anew.covariance *= 1.1;
  folder.write_model("cam1.cahv", "Dimensions = 640 480\n", anew, 0);
  const auto config = load_rig(folder.rig());
  ASSERT_TRUE(config) << config.error().message;
  ASSERT_EQ(config->warnings.size(), 1U);
  EXPECT_NE(config->warnings[0].find("joint.csv: the model of cam1 is not of this calibration"),
            std::string::npos);
  EXPECT_FALSE(config->rig.model_correlations.known());
}

TEST(JointCovariance, OfAnotherCalibrationIsRefused) {
  const JointRig folder(some_joint(1.0));
  folder.write("joint.csv", write_joint_covariance(some_joint(2.0)));
  const auto config = load_rig(folder.rig());
  ASSERT_FALSE(config);
  EXPECT_NE(config.error().message.find(
                "has the covariance of none of the models; expected the file of the calibration"),
            std::string::npos)
      << config.error().message;
  folder.write("rig.toml", replaced(kGoodRig, "frame_rate_hz = 25.0\n",
                                    "frame_rate_hz = 25.0\njoint_covariance = \"none.csv\"\n"));
  const auto missing = load_rig(folder.rig());
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("none.csv\": no such file"), std::string::npos)
      << missing.error().message;
}

}  // namespace
}  // namespace dottrack::config
