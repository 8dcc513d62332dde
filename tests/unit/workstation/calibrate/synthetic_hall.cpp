#include "tests/unit/workstation/calibrate/synthetic_hall.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace dottrack::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLength_m = 12.0;
constexpr double kWidth_m = 8.0;
constexpr double kHeight_m = 4.0;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return radius * std::cos(uniform(0.0, 2.0 * std::numbers::pi));
  }

 private:
  std::mt19937_64 engine_;
};

// On the floor, on boxes up to 1.5 m, on the walls.
Vector3d place_in_hall(Random& random) {
  const double x = random.uniform(-0.5, 0.5) * kLength_m;
  const double y = random.uniform(-0.5, 0.5) * kWidth_m;
  const double kind = random.uniform(0.0, 1.0);
  if (kind < 0.3) return {x, y, 0.0};
  if (kind < 0.85) return {x, y, random.uniform(0.2, 1.5)};
  const double side = random.uniform(0.0, 1.0) < 0.5 ? -0.5 : 0.5;
  const double z = random.uniform(0.2, 3.0);
  if (random.uniform(0.0, 1.0) < 0.5) return {x, side * kWidth_m, z};
  return {side * kLength_m, y, z};
}

Vector3d place_of_dot(const HallOptions& options, Random& random) {
  return options.extent * place_in_hall(random);
}

geometry::CameraModel camera(std::size_t i, const HallOptions& options, Random& random) {
  const double around = 2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) /
                        static_cast<double>(options.cameras);
  const Vector3d from(0.48 * kLength_m * std::cos(around), 0.48 * kWidth_m * std::sin(around),
                      kHeight_m + random.uniform(-0.2, 0.2));
  const Vector3d at =
      options.extent *
      Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(0.0, 0.6));
  const Vector3d a = (at - from).normalized();
  const Vector3d right = a.cross(Vector3d::UnitZ()).normalized();
  const double focal = options.focal_px * random.uniform(0.98, 1.02);
  const double hc = 0.5 * (kHallColumns - 1) + random.uniform(-6.0, 6.0);
  const double vc = 0.5 * (kHallRows - 1) + random.uniform(-6.0, 6.0);
  const Vector3d down = a.cross(right);
  const double vs = focal * (1.0 + options.aspect * random.uniform(-1.0, 1.0));
  const Vector3d o =
      a + options.axis * (random.uniform(-1.0, 1.0) * right + random.uniform(-1.0, 1.0) * down);
  Vector2d radial = options.radial;
  if (options.radial_sigma > 0.0) {
    for (double& r : radial) r *= 1.0 + options.radial_sigma * random.normal();
  }
  return geometry::Cahvor{from,
                          a,
                          focal * right + hc * a,
                          vs * down + vc * a,
                          o.normalized(),
                          {0.0, radial.x(), radial.y()}};
}

bool in_image(const geometry::CameraModel& model, const Vector3d& p, Vector2d& pixel) {
  return project(model, p, pixel) == geometry::OpticsStatus::ok && pixel.x() > 5.0 &&
         pixel.y() > 5.0 && pixel.x() < kHallColumns - 6.0 && pixel.y() < kHallRows - 6.0;
}

}  // namespace

Hall make_hall(const HallOptions& options) {
  Random random(options.seed * 1000003 + 17);
  Hall hall;
  for (std::size_t i = 0; i < options.cameras; ++i) {
    hall.truths.push_back(camera(i, options, random));
  }
  for (std::size_t j = 0; j < options.dots; ++j) {
    hall.places_m.push_back(place_of_dot(options, random));
    calibrate::SurveyedDot dot;
    dot.name = "dot" + std::to_string(j + 1);
    const Vector3d error(random.normal(), random.normal(), random.normal());
    dot.position_m = hall.places_m[j] + options.survey_sigma_m * error;
    dot.sigma_m = Vector3d::Constant(options.claimed_sigma_m);
    hall.dots.push_back(dot);
  }
  for (std::size_t i = 0; i < options.cameras; ++i) {
    calibrate::CameraViews views;
    views.name = "cam" + std::to_string(i + 1);
    views.width_px = kHallColumns;
    views.height_px = kHallRows;
    for (std::size_t j = 0; j < options.dots; ++j) {
      Vector2d pixel;
      if (!in_image(hall.truths[i], hall.places_m[j], pixel)) continue;
      const Vector2d noise(random.normal(), random.normal());
      views.observations.push_back(
          {j, pixel + options.image_sigma_px * noise, options.claimed_image_sigma_px});
    }
    hall.views.push_back(views);
  }
  for (int j = 0; j < 400; ++j) hall.unseen_m.push_back(place_of_dot(options, random));
  return hall;
}

double rms_on_unseen_px(const Hall& hall, std::size_t camera, const geometry::CameraModel& model,
                        std::size_t& count) {
  double sum = 0.0;
  std::size_t seen = 0;
  for (const Vector3d& p : hall.unseen_m) {
    Vector2d truth;
    Vector2d pixel(1e6, 1e6);
    if (!in_image(hall.truths[camera], p, truth)) continue;
    (void)project(model, p, pixel);
    sum += (pixel - truth).squaredNorm();
    ++seen;
  }
  count += seen;
  return std::sqrt(sum / static_cast<double>(seen == 0 ? 1 : seen));
}

}  // namespace dottrack::test
