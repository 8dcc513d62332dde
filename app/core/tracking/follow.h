#pragma once
// Tracking: one cycle from the target's previous pose to its next (paper section 3.2).

#include <array>
#include <span>

#include "app/core/camera_frame.h"
#include "app/core/estimation/locate.h"
#include "app/core/estimation/sighting.h"
#include "app/core/geometry/optics.h"
#include "app/core/image/identify.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "app/core/tracking/expected_dot.h"

namespace dottrack::tracking {

// What a cycle found, beside the pose: filled as far as the cycle came.
struct FollowResult {
  core::Reason reason = core::Reason::too_few_dots;  // none: the target was followed
  core::Pose pose;                                   // when followed
  std::array<core::DotState, core::kMaxDots> dots{};
  CameraSet cameras_used;
  std::uint8_t dots_used = 0;
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

  // Looks around each dot of the previous pose in every camera that can see it (3.2.2),
  // triangulates each dot seen by two or more (3.2.3) and locates the vehicle from three or more
  // (3.2.4). frames[i].image is not looked at unless delivered. regions[i] receives the regions
  // considered. A dot may move max_step_m since the previous pose.
  //
  // Where the target gives a dot's normal, the dot is not looked for by cameras that it turns away
  // from, and a region counts only if it may be the ellipse that the dot shows: in the previous
  // pose, and once more in the pose found, which is then found anew without the regions that may
  // not (3.3).
  //
  // `distrusted` cameras are looked through all the same, but nothing rests on what they see.
  const FollowResult& follow(std::span<const core::CameraFrame> frames, const core::Pose& previous,
                             std::span<image::Regions* const> regions, CameraSet distrusted = {});

  // What a camera saw in a dot's place in the last cycle, whether the pose rests on it or not;
  // null: nothing. Valid until the next cycle.
  const estimation::Sighting* sighting(std::size_t camera, std::size_t dot) const {
    const Found& found = found_[camera][dot];
    return found.any ? &found.sighting : nullptr;
  }

 private:
  struct Found {  // the region chosen for one dot in one camera
    bool any = false;
    bool bloomed = false;
    image::Region region;
    estimation::Sighting sighting;
  };
  using LocatedDots = StaticVector<estimation::LocatedDot, core::kMaxDots>;

  struct Attempt {  // at a pose
    core::Reason reason = core::Reason::too_few_dots;
    bool has_pose = false;  // one that fits, or one that does not fit well enough
  };

  void predict(const core::Pose& previous);
  void update(std::size_t camera, const ImageView& image, image::Regions& considered);
  void find_dot(std::size_t camera, std::size_t dot, const ImageView& image,
                image::Regions& considered);
  bool choose_region(std::size_t camera, const ImageView& image, const ExpectedDot& expected,
                     image::Regions& considered, Found& found);
  bool counts(std::size_t camera, std::size_t dot) const {
    return found_[camera][dot].any && !distrusted_.contains(camera);
  }
  void drop_shared_regions(std::size_t camera);
  void triangulate(LocatedDots& located);
  bool triangulate_dot(std::size_t dot, estimation::LocatedDot& located);
  bool drop_wrong_glimpses(LocatedDots& located) const;
  bool drop_wrong_shapes();
  bool has_wrong_shape(std::size_t camera, const PlacedDot& dot, const Found& found) const;
  Attempt locate(LocatedDots& located, const core::Pose& previous);
  bool steps_too_far() const;
  void record_views(const LocatedDots& located);
  void record_view(std::size_t camera, std::size_t dot);

  const core::Rig* rig_;
  std::span<const geometry::Optics> optics_;
  image::Identifier* identifier_;
  std::array<PlacedDot, core::kMaxDots> predicted_{};
  std::array<std::array<Found, core::kMaxDots>, kMaxCameras> found_{};
  image::Regions window_regions_;
  CameraSet distrusted_;
  FollowResult result_;
};

}  // namespace dottrack::tracking
