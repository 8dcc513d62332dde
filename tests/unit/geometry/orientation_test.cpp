#include "app/core/geometry/orientation.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <random>
#include <vector>

namespace dottrack::geometry {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

class Scene {
 public:
  explicit Scene(unsigned seed) : random_(seed) {}

  Points points(int n) {
    Points p;
    for (int i = 0; i < n; ++i) p.push_back(vector(0.5));
    return p;
  }
  RigidMotion motion() {
    std::normal_distribution<double> normal;
    Quaterniond q(normal(random_), normal(random_), normal(random_), normal(random_));
    return {vector(10.0), q.normalized()};
  }
  Vector3d vector(double reach) {
    std::uniform_real_distribution<double> place(-reach, reach);
    return {place(random_), place(random_), place(random_)};
  }

 private:
  std::mt19937 random_;
};

Points moved(const RigidMotion& motion, const Points& body) {
  Points world;
  for (const Vector3d& p : body) world.push_back(motion * p);
  return world;
}

// The same least-squares problem solved by singular values (Kabsch).
Matrix3d kabsch(const Points& body, const Points& world) {
  Vector3d mean_b = Vector3d::Zero();
  Vector3d mean_w = Vector3d::Zero();
  for (std::size_t i = 0; i < body.size(); ++i) {
    mean_b += body[i] / static_cast<double>(body.size());
    mean_w += world[i] / static_cast<double>(world.size());
  }
  Matrix3d s = Matrix3d::Zero();
  for (std::size_t i = 0; i < body.size(); ++i)
    s += (world[i] - mean_w) * (body[i] - mean_b).transpose();
  const Eigen::JacobiSVD<Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d flip =
      Vector3d(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant()).asDiagonal();
  return svd.matrixU() * flip * svd.matrixV().transpose();
}

TEST(AbsoluteOrientation, RecoversAnExactMotion) {
  Scene scene(1);
  for (int n = 3; n <= 16; ++n) {
    for (int trial = 0; trial < 50; ++trial) {
      const Points body = scene.points(n);
      const RigidMotion truth = scene.motion();
      RigidMotion motion;
      ASSERT_EQ(absolute_orientation(body, moved(truth, body), motion), OrientationStatus::ok);
      EXPECT_LT(motion.rotation.angularDistance(truth.rotation), 1e-7);
      EXPECT_LT((motion.translation_m - truth.translation_m).norm(), 1e-9);
      EXPECT_NEAR(motion.rotation.norm(), 1.0, 1e-15);
      EXPECT_LT(rms_residual(body, moved(truth, body), motion), 1e-9);
    }
  }
}

TEST(AbsoluteOrientation, OfNoisyPointsIsTheLeastSquaresOne) {
  Scene scene(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Points body = scene.points(5);
    Points world = moved(scene.motion(), body);
    for (Vector3d& p : world) p += scene.vector(0.02);
    RigidMotion motion;
    ASSERT_EQ(absolute_orientation(body, world, motion), OrientationStatus::ok);
    EXPECT_LT((motion.rotation.toRotationMatrix() - kabsch(body, world)).norm(), 1e-9);
  }
}

TEST(AbsoluteOrientation, OfAMirroredSetIsStillARotation) {
  Scene scene(3);
  const Points body = scene.points(6);
  Points mirrored = body;
  for (Vector3d& p : mirrored) p.x() = -p.x();
  RigidMotion motion;
  ASSERT_EQ(absolute_orientation(body, mirrored, motion), OrientationStatus::ok);
  EXPECT_NEAR(motion.rotation.toRotationMatrix().determinant(), 1.0, 1e-12);
  EXPECT_GT(rms_residual(body, mirrored, motion), 0.05);
}

TEST(AbsoluteOrientation, RefusesDegenerateSets) {
  RigidMotion motion;
  const Points two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(absolute_orientation(two, two, motion), OrientationStatus::too_few_points);
  const Points line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}};
  EXPECT_EQ(absolute_orientation(line, line, motion), OrientationStatus::degenerate);
  const Points same = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(absolute_orientation(same, same, motion), OrientationStatus::degenerate);
  const Points triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(absolute_orientation(triangle, {line.data(), 3}, motion),
            OrientationStatus::degenerate);
  EXPECT_EQ(absolute_orientation(triangle, two, motion), OrientationStatus::too_few_points);
}

TEST(AbsoluteOrientation, DoesNotDependOnTheOrderOfThePoints) {
  Scene scene(4);
  Points body = scene.points(7);
  Points world = moved(scene.motion(), body);
  for (Vector3d& p : world) p += scene.vector(0.01);
  RigidMotion first;
  ASSERT_EQ(absolute_orientation(body, world, first), OrientationStatus::ok);
  std::reverse(body.begin(), body.end());
  std::reverse(world.begin(), world.end());
  RigidMotion second;
  ASSERT_EQ(absolute_orientation(body, world, second), OrientationStatus::ok);
  EXPECT_LT(first.rotation.angularDistance(second.rotation), 1e-7);
  EXPECT_LT((first.translation_m - second.translation_m).norm(), 1e-12);
}

}  // namespace
}  // namespace dottrack::geometry
