#pragma once
// What the tracker made of one camera's image, drawn over it as in the paper's Fig. 2.

#include <cstddef>
#include <span>
#include <string>

#include "app/core/exposure/camera_light.h"
#include "app/core/image/region.h"
#include "app/core/rig.h"
#include "app/core/tick_result.h"
#include "app/workstation/canvas.h"

namespace dottrack::workstation {

struct OverlayColours {
  Colour dots{255, 60, 50};      // lines that connect the located dots
  Colour axes{60, 235, 70};      // the vehicle's axes, the forward one longer
  Colour regions{70, 190, 255};  // boxes around the regions considered
  Colour used{255, 220, 0};      // ellipses of the regions that served as dots
  Colour legend{255, 255, 255};
};
inline constexpr OverlayColours kOverlayColours{};

struct OverlayInput {
  ImageView image;  // empty: the camera did not deliver, and the picture says so
  std::string camera_name;
  const core::Rig& rig;
  std::size_t camera = 0;
  const core::TickResult& result;
  std::span<const image::Region> regions;
  const exposure::CameraLight* light = nullptr;  // none: the legend says nothing of it
};

// Lines in space are drawn through the camera's model, so they bend where its lens bends them.
Canvas draw_overlay(const OverlayInput& input);

}  // namespace dottrack::workstation
