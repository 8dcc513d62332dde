#include "app/core/acquisition/refine.h"

#include "app/core/estimation/dot_position.h"

namespace dottrack::acquisition {

bool refine_finalist(std::span<const CameraView> views, Finalist& finalist) {
  estimation::Views seen;
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    if (!finalist.cameras.contains(camera)) continue;
    seen.push_back(
        {camera, views[camera].camera, &views[camera].sightings[finalist.sighting[camera]]});
  }
  estimation::DotPosition dot;
  if (!estimation::locate_dot(seen, dot)) return false;
  finalist.position_m = dot.position_m;
  finalist.covariance_m2 = dot.covariance_m2;
  finalist.diameter_m = dot.diameter_m;
  finalist.cameras = dot.cameras;
  return true;
}

}  // namespace dottrack::acquisition
