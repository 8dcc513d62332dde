#include "app/core/acquisition/refine.h"

#include <algorithm>

#include "app/core/estimation/dot_position.h"

namespace dottrack::acquisition {
namespace {

constexpr int kRounds = 3;

PointViews views_of(const Finalist& finalist) {
  return {finalist.cameras, finalist.sighting};
}

// Those of the views that the point projects to within kSureResidual_px of.
PointViews close_views(std::span<const CameraView> views, const PointViews& seen,
                       const Eigen::Vector3d& point_m) {
  PointViews close;
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (!seen.cameras.contains(c)) continue;
    const estimation::Sighting& sighting = views[c].sightings[seen.sighting[c]];
    if ((sighting.pixel_of(point_m) - sighting.pixel).norm() <= kSureResidual_px) {
      close.set(c, seen.sighting[c]);
    }
  }
  return close;
}

bool find_agreement(std::span<const CameraView> views, const PointViews& seen,
                    const Eigen::Vector3d& crossing_m, int min_views, Finalist& finalist) {
  Finalist core;
  if (!refine_finalist(views, close_views(views, seen, crossing_m), core) || !is_sure(core)) {
    return false;
  }
  Finalist all = core;
  if (!refine_finalist(views, close_views(views, seen, core.position_m), all) || !is_sure(all)) {
    all = core;
  }
  if (all.cameras.size() < min_views) return false;
  finalist = all;
  return true;
}

}  // namespace

bool refine_finalist(std::span<const CameraView> views, const PointViews& seen,
                     Finalist& finalist) {
  estimation::Views used;
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    if (!seen.cameras.contains(camera)) continue;
    used.push_back({camera, views[camera].camera, &views[camera].sightings[seen.sighting[camera]]});
  }
  estimation::DotPosition dot;
  if (!estimation::locate_dot(used, dot)) return false;
  finalist.position_m = dot.position_m;
  finalist.covariance_m2 = dot.covariance_m2;
  finalist.diameter_m = dot.diameter_m;
  finalist.worst_residual_px = dot.worst_residual_px;
  finalist.cameras = dot.cameras;
  finalist.sighting = seen.sighting;
  return true;
}

bool find_finalist(std::span<const CameraView> views, const ViewFinder& finder,
                   const PointViews& seen, const Eigen::Vector3d& crossing_m, int min_views,
                   Finalist& finalist) {
  PointViews given = seen;
  bool found = false;
  for (int round = 0; round < kRounds; ++round) {
    Finalist next;
    if (!refine_finalist(views, given, next)) break;
    if (found &&
        (next.cameras.size() < finalist.cameras.size() || is_sure(next) < is_sure(finalist)))
      break;
    finalist = next;
    found = true;
    if (finalist.cameras.size() < std::max(min_views, 3)) break;
    const PointViews again = finder.close_views(finalist.position_m);
    if (same_views(again, given) || same_views(again, views_of(finalist))) break;
    given = again;
  }
  if (!found || is_sure(finalist)) return found;
  find_agreement(views, seen, crossing_m, min_views, finalist);
  return true;
}

}  // namespace dottrack::acquisition
