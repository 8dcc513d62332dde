// A dot's centre: from its rim, and corrected for the perspective of a disc.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "app/workstation/calibrate/labelling/disc_fit.h"
#include "app/workstation/calibrate/labelling/eccentricity.h"

namespace dottrack::calibrate {
namespace {

struct Painted {
  std::vector<std::uint8_t> pixels =
      std::vector<std::uint8_t>(static_cast<std::size_t>(40 * 40), 50);
  ImageView view() const { return {pixels.data(), 40, 40, 40}; }
};

// A disc of which each pixel is covered as 16 x 16 points say; light(x, y) is how bright it is.
template <class Light>
Painted disc(const Eigen::Vector2d& centre, double radius, Light light) {
  Painted p;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      double sum = 0.0;
      for (int i = 0; i < 256; ++i) {
        const Eigen::Vector2d at(x - 0.5 + (i % 16 + 0.5) / 16.0, y - 0.5 + (i / 16 + 0.5) / 16.0);
        if ((at - centre).norm() < radius) sum += light(at) / 256.0;
      }
      p.pixels[static_cast<std::size_t>(y * 40 + x)] = static_cast<std::uint8_t>(50.5 + sum);
    }
  }
  return p;
}

TEST(DiscFit, FindsTheCentreToAFewHundredthsOfAPixel) {
  int found = 0;
  for (const double radius : {2.5, 3.5, 6.0, 10.0}) {
    const Eigen::Vector2d centre(19.3, 20.1);
    const Painted p = disc(centre, radius, [](const auto&) { return 100.0; });
    const auto fit = fit_disc(p.view(), {{19.0, 20.0}, radius, radius, 0.0, 80.0, 0.0});
    ASSERT_TRUE(fit) << radius;
    EXPECT_LT((fit->centre - centre).norm(), 0.03) << radius;
    EXPECT_NEAR(fit->semi_major_px, radius, 0.15);
    EXPECT_LT(fit->sigma_px, 0.05);
    ++found;
  }
  EXPECT_EQ(found, 4);
}

// Brighter on one side than on the other: the centre of light is off, the rim is not.
TEST(DiscFit, IsNotDrawnToTheLight) {
  const Eigen::Vector2d centre(20.2, 19.6);
  const Painted p = disc(
      centre, 4.0, [&](const Eigen::Vector2d& at) { return 60.0 + 4.0 * (at.x() - centre.x()); });
  const auto fit = fit_disc(p.view(), {{20.5, 19.5}, 4.0, 4.0, 0.0, 60.0, 0.0});
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->centre - centre).norm(), 0.2);
  double light = 0.0;
  double moment = 0.0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const double over = p.pixels[static_cast<std::size_t>(y * 40 + x)] - 50.0;
      light += over;
      moment += over * x;
    }
  }
  EXPECT_GT(moment / light - centre.x(), 1.3 * std::abs(fit->centre.x() - centre.x()));
}

TEST(DiscFit, RefusesWhatIsNotThere) {
  const Painted p = disc({20.0, 20.0}, 4.0, [](const auto&) { return 100.0; });
  EXPECT_FALSE(fit_disc(p.view(), {{3.0, 3.0}, 4.0, 4.0, 0.0, 80.0, 0.0}));    // at the border
  EXPECT_FALSE(fit_disc(p.view(), {{26.0, 26.0}, 4.0, 4.0, 0.0, 80.0, 0.0}));  // beside it
}

// Against the middle of many points all over the disc, weighed as the image stretches them.
TEST(Eccentricity, IsThatOfTheDiscsPoints) {
  geometry::Cahv model;
  model.h = {500.0, 0.0, 320.0};
  model.v = {0.0, 500.0, 240.0};
  model.a = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d centre(0.5, 0.2, 3.0);
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 0.3, -1.0).normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d w = normal.cross(u);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (int i = -200; i <= 200; ++i) {
    for (int j = -200; j <= 200; ++j) {
      if (i * i + j * j > 200 * 200) continue;
      const Eigen::Vector3d at = centre + 0.05 / 200.0 * (i * u + j * w);
      const auto pixel = [&](const Eigen::Vector3d& p) {
        Eigen::Vector2d out;
        EXPECT_EQ(geometry::project(model, p, out), geometry::OpticsStatus::ok);
        return out;
      };
      const Eigen::Vector2d here = pixel(at);
      const Eigen::Vector2d e = pixel(at + 1e-5 * u) - here;
      const Eigen::Vector2d f = pixel(at + 1e-5 * w) - here;
      const double stretch = std::abs(e.x() * f.y() - e.y() * f.x());
      sum += stretch * here;
      area += stretch;
    }
  }
  Eigen::Vector2d middle;
  ASSERT_EQ(geometry::project(model, centre, middle), geometry::OpticsStatus::ok);
  const Eigen::Vector2d expected = sum / area - middle;
  EXPECT_GT(expected.norm(), 0.05);
  EXPECT_LT((eccentricity_px(model, centre, normal, 0.05) - expected).norm(), 0.002);
}

}  // namespace
}  // namespace dottrack::calibrate
