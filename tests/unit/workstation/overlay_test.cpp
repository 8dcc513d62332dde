#include "app/workstation/overlay.h"

#include <gtest/gtest.h>

#include "tests/support/disc_scene.h"
#include "tests/unit/workstation/colours.h"

namespace dottrack::workstation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::DiscScene;

class OverlayTest : public testing::Test {
 protected:
  static constexpr std::size_t kCamera = 2;
  static constexpr std::uint64_t kTick = 3;

  OverlayTest() {
    result_.has_pose = true;
    result_.state = core::State::tracking;
    result_.pose = DiscScene::pose_at(kTick);
    for (std::size_t i = 0; i < rig_.target.dots.size(); ++i) {
      result_.dots[i].located = true;
      result_.dots[i].position_m = at_vehicle(rig_.target.dots[i].position_m);
    }
  }

  Vector3d at_vehicle(const Vector3d& p) const {
    return result_.pose.orientation * p + result_.pose.position_m;
  }
  Vector2d pixel_of(const Vector3d& p_world) const {
    Vector2d pixel;
    if (geometry::project(rig_.cameras[kCamera].model, p_world, pixel) !=
        geometry::OpticsStatus::ok) {
      throw std::runtime_error("the camera does not see the point");
    }
    return pixel;
  }
  Canvas draw() const {
    return draw_overlay({image_.view(), "cam2", rig_, kCamera, result_, regions_});
  }

  DiscScene scene_;
  core::Rig rig_ = scene_.rig();
  test::GreyImage image_ = scene_.image_at(kCamera, kTick);
  core::TickResult result_;
  std::vector<image::Region> regions_;
};

TEST_F(OverlayTest, LinesMeetAtEveryDot) {
  const Canvas canvas = draw();
  for (const core::TargetDot& dot : rig_.target.dots) {
    EXPECT_TRUE(near(canvas, pixel_of(at_vehicle(dot.position_m)), kOverlayColours.dots, 1));
  }
}

TEST_F(OverlayTest, AxesStartAtTheVehicleAndTheForwardOneIsLonger) {
  const Canvas canvas = draw();
  EXPECT_TRUE(near(canvas, pixel_of(result_.pose.position_m), kOverlayColours.axes, 1));
  // The target's largest distance is about 0.83 m: axes of 0.28 m, the forward one of 0.55 m.
  EXPECT_TRUE(near(canvas, pixel_of(at_vehicle({0.50, 0, 0})), kOverlayColours.axes, 1));
  EXPECT_TRUE(near(canvas, pixel_of(at_vehicle({0, 0.25, 0})), kOverlayColours.axes, 1));
  EXPECT_TRUE(near(canvas, pixel_of(at_vehicle({0, 0, 0.25})), kOverlayColours.axes, 1));
  EXPECT_FALSE(near(canvas, pixel_of(at_vehicle({0, 0.45, 0})), kOverlayColours.axes, 1));
}

TEST_F(OverlayTest, EveryRegionConsideredHasABox) {
  image::Region region;
  region.x_min = 100;
  region.x_max = 110;
  region.y_min = 200;
  region.y_max = 206;
  regions_ = {region};
  const Canvas canvas = draw();
  EXPECT_TRUE(near(canvas, {97, 203}, kOverlayColours.regions, 0));
  EXPECT_TRUE(near(canvas, {113, 203}, kOverlayColours.regions, 0));
  EXPECT_FALSE(near(canvas, {105, 203}, kOverlayColours.regions, 2));
}

TEST_F(OverlayTest, ADotThatServedHasItsEllipse) {
  core::DotView& view = result_.dots[0].views[kCamera];
  view.used = true;
  view.pixel = {350.0F, 20.0F};
  view.semi_major_px = 9.0F;
  view.semi_minor_px = 5.0F;
  const Canvas canvas = draw();
  EXPECT_TRUE(near(canvas, {359, 20}, kOverlayColours.used, 1));
  EXPECT_TRUE(near(canvas, {350, 15}, kOverlayColours.used, 1));
}

TEST_F(OverlayTest, WithoutAPoseThereAreNeitherLinesNorAxes) {
  result_.has_pose = false;
  const Canvas canvas = draw();
  EXPECT_EQ(count(canvas, kOverlayColours.dots), 0);
  EXPECT_EQ(count(canvas, kOverlayColours.axes), 0);
  EXPECT_GT(count(canvas, kOverlayColours.legend), 100);
}

TEST_F(OverlayTest, WithoutAnImageThePictureIsOfTheCamerasSizeAndSaysSo) {
  result_.has_pose = false;
  const Canvas canvas = draw_overlay({{}, "cam2", rig_, kCamera, result_, regions_});
  EXPECT_EQ(canvas.width_px(), rig_.cameras[kCamera].width_px);
  EXPECT_EQ(canvas.height_px(), rig_.cameras[kCamera].height_px);
  EXPECT_GT(count(canvas, kOverlayColours.legend), 100);
}

TEST_F(OverlayTest, ATargetBehindTheCameraIsNotDrawn) {
  result_.pose.position_m.z() = 50.0;
  for (core::DotState& dot : result_.dots) dot.position_m.z() = 50.0;
  const Canvas canvas = draw();
  EXPECT_EQ(count(canvas, kOverlayColours.dots), 0);
  EXPECT_EQ(count(canvas, kOverlayColours.axes), 0);
}

}  // namespace
}  // namespace dottrack::workstation
