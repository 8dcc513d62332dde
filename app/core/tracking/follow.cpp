#include "app/core/tracking/follow.h"

#include <algorithm>
#include <cmath>

#include "app/core/estimation/dot_ellipse.h"
#include "app/core/estimation/dot_position.h"
#include "app/core/image/band.h"
#include "app/core/image/bloom.h"
#include "app/core/image/dot_centre.h"

namespace dottrack::tracking {
namespace {

// The paper's window and gate around a dot's previous place, in dot radii (3.2.2). The rim keeps
// the blurred edge of a small dot inside its window.
constexpr double kWindowRadii = 3.0;
constexpr double kGateRadii = 1.5;
constexpr double kWindowRim_px = 2.0;

image::Window window_around(const ExpectedDot& expected) {
  const double reach = kWindowRadii * expected.radius_px + kWindowRim_px;
  return {static_cast<int>(std::floor(expected.pixel.x() - reach)),
          static_cast<int>(std::floor(expected.pixel.y() - reach)),
          static_cast<int>(std::ceil(expected.pixel.x() + reach)),
          static_cast<int>(std::ceil(expected.pixel.y() + reach))};
}

bool same_region(const image::Region& a, const image::Region& b) {
  const double reach = 0.5 * (a.semi_minor_px + b.semi_minor_px);
  return (a.centroid_px - b.centroid_px).squaredNorm() < reach * reach;
}

// What a bloomed dot's centre is trusted to, of what another's is.
constexpr double kBloomedDoubt = 8.0;

bool is_bloomed(const ImageView& image, const image::Region& region, const ExpectedDot& expected) {
  const geometry::ImageEllipse circle{expected.radius_px, expected.radius_px, 0.0};
  const geometry::ImageEllipse& shape = expected.has_ellipse ? expected.ellipse : circle;
  return image::bloom_evidence(
             image, region,
             image::extent_of(shape.semi_major_px, shape.semi_minor_px, shape.angle_rad))
      .bloomed();
}

core::DotView view_of(const image::Region& region, double residual_px, bool used, bool bloomed) {
  return {.seen = true,
          .used = used,
          .bloomed = bloomed,
          .pixel = region.centroid_px.cast<float>(),
          .semi_major_px = static_cast<float>(region.semi_major_px),
          .semi_minor_px = static_cast<float>(region.semi_minor_px),
          .angle_rad = static_cast<float>(region.angle_rad),
          .residual_px = static_cast<float>(residual_px)};
}

}  // namespace

Follower::Follower(const core::Rig& rig, std::span<const geometry::Optics> optics,
                   image::Identifier& identifier)
    : rig_(&rig), optics_(optics), identifier_(&identifier) {}

void Follower::predict(const core::Pose& previous) {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    predicted_[dot] = placed(rig_->target.dots[dot], previous);
  }
}

// The region nearest to the dot's place that may be the dot; false when there is none.
bool Follower::choose_region(std::size_t camera, const ImageView& image,
                             const ExpectedDot& expected, image::Regions& considered,
                             Found& found) {
  double closest_px = kGateRadii * expected.radius_px;
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
    found.region = region;
  }
  found.bloomed = any && is_bloomed(image, found.region, expected);
  if (found.bloomed) ++result_.bloomed[camera];
  return any;
}

void Follower::find_dot(std::size_t camera, std::size_t dot, const ImageView& image,
                        image::Regions& considered) {
  const core::Camera& model = rig_->cameras[camera];
  ExpectedDot expected;
  if (!expect(model, optics_[camera], predicted_[dot], expected)) return;
  identifier_->identify(image, window_around(expected), image::band_of(model), expected.gate,
                        window_regions_);
  Found& found = found_[camera][dot];
  if (!choose_region(camera, image, expected, considered, found)) return;
  found.region.centroid_px = image::dot_centre(image, found.region);
  const double diameter_m = rig_->target.dots[dot].diameter_m;
  found.any = estimation::make_sighting(model, optics_[camera], {diameter_m, diameter_m},
                                        found.region, found.sighting);
  if (found.bloomed) found.sighting.line.sigma_rad *= kBloomedDoubt;
}

// No two dots may rest on one region: neither of them is seen by this camera then.
void Follower::drop_shared_regions(std::size_t camera) {
  auto& found = found_[camera];
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

bool Follower::triangulate_dot(std::size_t dot, estimation::LocatedDot& located) {
  estimation::Views views;
  for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
    if (!counts(camera, dot)) continue;
    views.push_back({camera, &rig_->cameras[camera], &found_[camera][dot].sighting});
  }
  core::DotState& state = result_.dots[dot];
  state = {};
  estimation::DotPosition position;
  if (estimation::locate_dot(views, position)) {
    located = estimation::triangulated_dot(dot, position.position_m, position.covariance_m2);
    state.located = true;
    state.position_m = position.position_m;
    state.position_sigma_m = std::sqrt(position.covariance_m2.trace());
    state.diameter_m = position.diameter_m;
    state.cameras = position.cameras;
    return true;
  }
  if (views.size() != 1) return false;
  located = estimation::glimpsed_dot(dot, views[0].sighting->line, predicted_[dot].place_m);
  state.cameras.insert(views[0].camera);
  return true;
}

void Follower::triangulate(LocatedDots& located) {
  located.clear();
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    estimation::LocatedDot position;
    if (triangulate_dot(dot, position)) located.push_back(position);
  }
}

// A glimpse has no second view to contradict it: the pose must put the dot into its region.
bool Follower::drop_wrong_glimpses(LocatedDots& located) const {
  const auto wrong = [&](const estimation::LocatedDot& dot) {
    if (dot.in_depth) return false;
    const Eigen::Vector3d place =
        result_.pose.orientation * rig_->target.dots[dot.dot].position_m + result_.pose.position_m;
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      if (!counts(camera, dot.dot)) continue;
      const estimation::Sighting& glimpse = found_[camera][dot.dot].sighting;
      return !glimpse.box_contains(glimpse.pixel_of(place));
    }
    return true;
  };
  const auto kept = std::remove_if(located.begin(), located.end(), wrong);
  const bool any = kept != located.end();
  located.erase(kept, located.end());
  return any;
}

// The region's ellipse against the disc's in the pose found, through the derivatives at the region.
bool Follower::has_wrong_shape(std::size_t camera, const PlacedDot& dot, const Found& found) const {
  const core::Camera& model = rig_->cameras[camera];
  if (!faces(model, dot)) return true;
  const double range_m = (dot.place_m - geometry::centre(model.model)).norm();
  const geometry::ImageEllipse expected = geometry::disc_ellipse(
      found.sighting.pixels_per_rad, dot.normal, 0.5 * dot.diameter_m / range_m);
  return !estimation::may_be(expected, estimation::ellipse_of(found.region));
}

bool Follower::drop_wrong_shapes() {
  bool any = false;
  for (std::size_t i = 0; i < rig_->target.dots.size(); ++i) {
    const PlacedDot dot = placed(rig_->target.dots[i], result_.pose);
    if (!dot.has_normal()) continue;
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      Found& found = found_[camera][i];
      if (!found.any || !has_wrong_shape(camera, dot, found)) continue;
      any = any || counts(camera, i);
      found.any = false;
      ++result_.rejected_ellipse[camera];
    }
  }
  return any;
}

bool Follower::steps_too_far() const {
  for (std::size_t dot = 0; dot < rig_->target.dots.size(); ++dot) {
    const Eigen::Vector3d place =
        result_.pose.orientation * rig_->target.dots[dot].position_m + result_.pose.position_m;
    if ((place - predicted_[dot].place_m).norm() > rig_->target.max_step_m) return true;
  }
  return false;
}

Follower::Attempt Follower::locate(LocatedDots& located, const core::Pose& previous) {
  for (const estimation::LocatedDot& dot : located) {
    if ((dot.position_m - predicted_[dot.dot].place_m).norm() > rig_->target.max_step_m) {
      return {core::Reason::step_too_large, false};
    }
  }
  const auto attempt = [&] {
    return estimation::locate(rig_->target, as_span(located), rig_->limits.max_rms_residual_m,
                              &previous, result_.pose);
  };
  const auto has_pose = [](estimation::LocateStatus status) {
    return status == estimation::LocateStatus::ok || status == estimation::LocateStatus::residual;
  };
  estimation::LocateStatus status = attempt();
  if (has_pose(status) && drop_wrong_glimpses(located)) status = attempt();
  if (status == estimation::LocateStatus::ok && steps_too_far()) {
    return {core::Reason::step_too_large, true};
  }
  return {estimation::reason_of(status), has_pose(status)};
}

void Follower::record_views(const LocatedDots& located) {
  result_.dots_used = static_cast<std::uint8_t>(located.size());
  for (const estimation::LocatedDot& dot : located) {
    core::DotState& state = result_.dots[dot.dot];
    if (!dot.in_depth) {
      state.position_m = result_.pose.orientation * rig_->target.dots[dot.dot].position_m +
                         result_.pose.position_m;
    }
    for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
      if (found_[camera][dot.dot].any) record_view(camera, dot.dot);
    }
  }
}

void Follower::record_view(std::size_t camera, std::size_t dot) {
  core::DotState& state = result_.dots[dot];
  const image::Region& region = found_[camera][dot].region;
  Eigen::Vector2d pixel;
  if (geometry::project(rig_->cameras[camera].model, state.position_m, pixel) !=
      geometry::OpticsStatus::ok) {
    return;
  }
  const bool used = state.cameras.contains(camera);
  state.views[camera] =
      view_of(region, (pixel - region.centroid_px).norm(), used, found_[camera][dot].bloomed);
  if (used) result_.cameras_used.insert(camera);
}

const FollowResult& Follower::follow(std::span<const core::CameraFrame> frames,
                                     const core::Pose& previous,
                                     std::span<image::Regions* const> regions,
                                     CameraSet distrusted) {
  result_ = FollowResult{};
  distrusted_ = distrusted;
  predict(previous);
  for (std::size_t camera = 0; camera < rig_->cameras.size(); ++camera) {
    for (Found& found : found_[camera]) found.any = false;
    regions[camera]->clear();
    if (frames[camera].delivered) update(camera, frames[camera].image, *regions[camera]);
  }
  LocatedDots located;
  triangulate(located);
  Attempt attempt = locate(located, previous);
  if (attempt.has_pose && drop_wrong_shapes()) {
    triangulate(located);
    attempt = locate(located, previous);
  }
  result_.reason = attempt.reason;
  record_views(located);
  return result_;
}

}  // namespace dottrack::tracking
