#include "app/core/tracking/follow.h"

#include <algorithm>
#include <cmath>

#include "app/core/estimation/dot_ellipse.h"
#include "app/core/image/band.h"
#include "app/core/image/bloom.h"
#include "app/core/image/dot_fit.h"

namespace dottrack::tracking {
namespace {

// The paper's window and gate around a dot's previous place, in dot radii (3.2.2). The rim keeps
// the blurred edge of a small dot inside its window.
constexpr double kWindowRadii = 3.0;
constexpr double kGateRadii = 1.5;
constexpr double kWindowRim_px = 2.0;
constexpr double kMaxSpread = 4.0;  // that a window grows by, in dot radii

image::Window window_around(const ExpectedDot& expected, double spread_px) {
  const double reach = kWindowRadii * expected.radius_px + kWindowRim_px + spread_px;
  return {static_cast<int>(std::floor(expected.pixel.x() - reach)),
          static_cast<int>(std::floor(expected.pixel.y() - reach)),
          static_cast<int>(std::ceil(expected.pixel.x() + reach)),
          static_cast<int>(std::ceil(expected.pixel.y() + reach))};
}

bool same_region(const image::Region& a, const image::Region& b) {
  const double reach = 0.5 * (a.semi_minor_px + b.semi_minor_px);
  return (a.centroid_px - b.centroid_px).squaredNorm() < reach * reach;
}

// Of a bloomed dot's centre, in semi-minor axes.
constexpr double kBloomedDoubt = 0.25;

bool is_bloomed(const ImageView& image, const image::Region& region, const ExpectedDot& expected) {
  const geometry::ImageEllipse circle{expected.radius_px, expected.radius_px, 0.0};
  const geometry::ImageEllipse& shape = expected.has_ellipse ? expected.ellipse : circle;
  return image::bloom_evidence(
             image, region,
             image::extent_of(shape.semi_major_px, shape.semi_minor_px, shape.angle_rad))
      .bloomed();
}

void measure(const ImageView& image, const ExpectedDot& expected, SeenDot& seen) {
  const image::ExpectedOutline outline{expected.ellipse.semi_major_px,
                                       expected.ellipse.semi_minor_px, expected.ellipse.angle_rad};
  const image::DotFit fit =
      image::fit_dot(image, seen.region, expected.has_ellipse ? &outline : nullptr);
  seen.region.centroid_px = fit.centre_px;
  seen.covariance_px2 = fit.covariance_px2;
  seen.flaw = fit.flaw;
  seen.light = fit.light;
  if (!seen.bloomed || seen.flaw != core::DotFlaw::none) return;
  const double doubt_px = kBloomedDoubt * seen.region.semi_minor_px;
  seen.covariance_px2 += doubt_px * doubt_px * Eigen::Matrix2d::Identity();
  seen.flaw = core::DotFlaw::saturated;
}

}  // namespace

Follower::Follower(const core::Rig& rig, std::span<const geometry::Optics> optics,
                   image::Identifier& identifier)
    : rig_(&rig), optics_(optics), identifier_(&identifier), locator_(rig) {}

void Follower::predict(const Expectation& expected, std::span<const core::CameraFrame> frames) {
  expected_ = expected;
  times_ = {};
  times_.motion = expected.motion;
  for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
    if (!expected.moving || !frames[camera].delivered) continue;
    times_.after_s[camera] = to_seconds(frames[camera].mid_exposure - expected.at);
  }
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    predicted_[dot] = placed(rig_->target.dots[dot], expected.pose);
  }
}

double Follower::spread_px(const ExpectedDot& expected) const {
  return std::min(expected_.spread_m * expected.pixels_per_m, kMaxSpread * expected.radius_px);
}

// The region nearest to the dot's place that may be the dot; false when there is none.
bool Follower::choose_region(std::size_t camera, const ImageView& image,
                             const ExpectedDot& expected, image::Regions& considered,
                             SeenDot& seen) {
  double closest_px = kGateRadii * expected.radius_px + spread_px(expected);
  bool any = false;
  for (const image::Region& region : window_regions_) {
    static_cast<void>(try_push_back(considered, region));
    const double distance_px = (region.centroid_px - expected.pixel).norm();
    if (region.touches_border || distance_px > closest_px) continue;
    if (expected.has_ellipse &&
        !estimation::may_be(expected.ellipse, estimation::ellipse_of(region))) {
      ++result_.rejected_ellipse[camera];
      if (is_bloomed(image, region, expected)) ++result_.bloomed[camera];
      continue;
    }
    closest_px = distance_px;
    any = true;
    seen.region = region;
  }
  seen.bloomed = any && is_bloomed(image, seen.region, expected);
  if (seen.bloomed) ++result_.bloomed[camera];
  return any;
}

void Follower::find_dot(std::size_t camera, std::size_t dot, const ImageView& image,
                        image::Regions& considered) {
  const core::Camera& model = rig_->cameras[camera];
  PlacedDot then = predicted_[dot];
  then.place_m += way_of(expected_, then, times_.after_s[camera]);
  ExpectedDot expected;
  if (!expect(model, optics_[camera], then, expected)) return;
  identifier_->identify(image, window_around(expected, spread_px(expected)), image::band_of(model),
                        expected.gate, window_regions_);
  SeenDot& seen = seen_.by_camera[camera][dot];
  if (!choose_region(camera, image, expected, considered, seen)) return;
  measure(image, expected, seen);
  const double diameter_m = rig_->target.dots[dot].diameter_m;
  seen.any = estimation::make_sighting(model, optics_[camera], {diameter_m, diameter_m},
                                       seen.region, seen.sighting);
}

// No two dots may rest on one region: neither of them is seen by this camera then.
void Follower::drop_shared_regions(std::size_t camera) {
  auto& found = seen_.by_camera[camera];
  std::array<bool, core::kMaxDots> shared{};
  for (std::size_t i = 0; i < rig_->target.dots.size(); ++i) {
    for (std::size_t j = i + 1; j < rig_->target.dots.size(); ++j) {
      if (!found[i].any || !found[j].any || !same_region(found[i].region, found[j].region))
        continue;
      shared[i] = shared[j] = true;
    }
  }
  for (std::size_t i = 0; i < rig_->target.dots.size(); ++i) {
    if (shared[i]) found[i].any = false;
  }
}

void Follower::update(std::size_t camera, const ImageView& image, image::Regions& considered) {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    find_dot(camera, dot, image, considered);
  }
  drop_shared_regions(camera);
}

// The region's ellipse against the disc's in the pose found, through the derivatives at the region.
bool Follower::has_wrong_shape(std::size_t camera, const PlacedDot& dot,
                               const SeenDot& seen) const {
  const core::Camera& model = rig_->cameras[camera];
  if (!faces(model, dot)) return true;
  const double range_m = (dot.place_m - geometry::centre(model.model)).norm();
  const geometry::ImageEllipse expected = geometry::disc_ellipse(
      seen.sighting.pixels_per_rad, dot.normal, 0.5 * dot.diameter_m / range_m);
  return !estimation::may_be(expected, estimation::ellipse_of(seen.region));
}

bool Follower::drop_wrong_shapes() {
  bool any = false;
  for (std::size_t i = 0; i < rig_->target.dots.size(); ++i) {
    const PlacedDot dot = placed(rig_->target.dots[i], locator_.fit().pose);
    if (!dot.has_normal()) continue;
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      SeenDot& seen = seen_.by_camera[camera][i];
      if (!seen.any || !has_wrong_shape(camera, dot, seen)) continue;
      any = any || seen_.counts(camera, i);
      seen.any = false;
      ++result_.rejected_ellipse[camera];
    }
  }
  return any;
}

void Follower::report(core::Reason reason) {
  result_.reason = reason;
  result_.pose = locator_.fit().pose;
  result_.systematic = locator_.fit().systematic;
  result_.spread = locator_.fit().spread;
  result_.dot_sigma_m = locator_.fit().dot_sigma_m;
  result_.dots = locator_.dots();
  result_.dots_used = static_cast<std::uint8_t>(locator_.dots_used());
  result_.views_used = static_cast<std::uint16_t>(locator_.views_used());
  result_.views_left_out = static_cast<std::uint16_t>(locator_.views_left_out());
  for (const core::DotState& dot : result_.dots) {
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      if (dot.cameras.contains(camera)) result_.cameras_used.insert(camera);
    }
  }
}

const FollowResult& Follower::follow(std::span<const core::CameraFrame> frames,
                                     const Expectation& expected,
                                     std::span<image::Regions* const> regions,
                                     CameraSet distrusted) {
  result_ = FollowResult{};
  seen_.distrusted = distrusted;
  predict(expected, frames);
  for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
    for (SeenDot& seen : seen_.by_camera[camera]) seen.any = false;
    regions[camera]->clear();
    if (frames[camera].delivered) update(camera, frames[camera].image, *regions[camera]);
  }
  take_out_uneven_light(*rig_, predicted_, seen_);
  core::Reason reason = locator_.locate(seen_, expected_, predicted_, times_);
  if (locator_.has_pose() && drop_wrong_shapes()) {
    reason = locator_.locate(seen_, expected_, predicted_, times_);
  }
  report(reason);
  return result_;
}

}  // namespace dottrack::tracking
