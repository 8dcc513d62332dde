#pragma once
// Tracking: one cycle from the target's previous pose to its next (paper section 3.2).

#include <array>
#include <span>

#include "app/core/camera_frame.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "app/core/tracking/expected_dot.h"
#include "app/core/tracking/pose_locator.h"
#include "app/core/tracking/seen_dots.h"

namespace dottrack::tracking {

// What a cycle found, beside the pose: filled as far as the cycle came.
struct FollowResult {
  core::Reason reason = core::Reason::too_few_dots;                // none: the target was followed
  core::Pose pose;                                                 // when followed
  estimation::Matrix6d systematic = estimation::Matrix6d::Zero();  // part of its covariance
  estimation::SpreadEvidence spread;  // of the dots about their places on the target
  double dot_sigma_m = 0.0;           // of these places, as the covariance has it
  std::array<core::DotState, core::kMaxDots> dots{};
  CameraSet cameras_used;
  std::uint8_t dots_used = 0;
  std::uint16_t views_used = 0;
  std::uint16_t views_left_out = 0;  // seen in a dot's place, but at odds with the others
  // Regions in a dot's place, by camera, that do not have the shape of that dot.
  std::array<std::uint32_t, kMaxCameras> rejected_ellipse{};
  // Regions in a dot's place, by camera, that blooming has grown.
  std::array<std::uint32_t, kMaxCameras> bloomed{};
};

// Follows the target from frame to frame. The caller keeps the pose; nothing is remembered here.
class Follower {
 public:
  // The rig, the optics and the identifier must outlive the object.
  Follower(const core::Rig& rig, std::span<const geometry::Optics> optics,
           image::Identifier& identifier);

  // Looks around each dot's expected place in every camera that can see it (3.2.2) and locates the
  // vehicle by what it finds there (3.2.3, 3.2.4). frames[i].image is not looked at unless
  // delivered. regions[i] receives the regions considered. A dot may be max_step_m from where it is
  // expected. The pose is that of the expectation's instant; cameras may have exposed at others.
  //
  // Where the target gives a dot's normal, the dot is not looked for by cameras that it turns away
  // from, and a region counts only if it may be the ellipse that the dot shows: as expected, and
  // once more in the pose found, which is then found anew without the regions that may not (3.3).
  //
  // `distrusted` cameras are looked through all the same, but nothing rests on what they see.
  const FollowResult& follow(std::span<const core::CameraFrame> frames, const Expectation& expected,
                             std::span<image::Regions* const> regions, CameraSet distrusted = {});

  // What a camera saw in a dot's place in the last cycle, whether the pose rests on it or not;
  // null: nothing. Valid until the next cycle.
  const estimation::Sighting* sighting(std::size_t camera, std::size_t dot) const {
    const SeenDot& seen = seen_.by_camera[camera][dot];
    return seen.any ? &seen.sighting : nullptr;
  }

  // The pose found in the last cycle, and what each camera says of it: for a filter.
  const estimation::PoseFit& fit() const { return locator_.fit(); }

 private:
  void predict(const Expectation& expected, std::span<const core::CameraFrame> frames);
  void update(std::size_t camera, const ImageView& image, image::Regions& considered);
  void find_dot(std::size_t camera, std::size_t dot, const ImageView& image,
                image::Regions& considered);
  bool choose_region(std::size_t camera, const ImageView& image, const ExpectedDot& expected,
                     image::Regions& considered, SeenDot& seen);
  void drop_shared_regions(std::size_t camera);
  bool drop_wrong_shapes();
  bool has_wrong_shape(std::size_t camera, const PlacedDot& dot, const SeenDot& seen) const;
  double spread_px(const ExpectedDot& expected) const;
  void report(core::Reason reason);

  const core::Rig* rig_;
  std::span<const geometry::Optics> optics_;
  image::Identifier* identifier_;
  Expectation expected_;
  PlacedDots predicted_{};  // at the expectation's instant
  estimation::CaptureTimes times_;
  SeenDots seen_;
  PoseLocator locator_;
  image::Regions window_regions_;
  FollowResult result_;
};

}  // namespace dottrack::tracking
