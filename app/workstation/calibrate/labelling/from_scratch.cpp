#include "app/workstation/calibrate/labelling/from_scratch.h"

#include <algorithm>
#include <cmath>

#include "app/workstation/calibrate/labelling/likenesses.h"
#include "app/workstation/calibrate/labelling/sketch_start.h"

namespace dottrack::calibrate {
namespace {

constexpr std::size_t kSightingsAKind = 30;
constexpr std::size_t kKinds = 400;
constexpr std::size_t kMostGrown = 600;
constexpr double kLikeMargin = 12.0;

}  // namespace

std::vector<Growth> labels_from_scratch(const Scene& scene, const SurveyIndex& survey,
                                        const SketchPrior& prior) {
  constexpr double kPatchScale_px = 1.0;
  const std::vector<PatchKind> kinds = patch_kinds(scene, survey);
  std::size_t grown = 0;
  for (std::size_t k = 0; k < std::min(kKinds, kinds.size()) && grown < kMostGrown; ++k) {
    for (const Sighting& sighting : sightings(scene, kinds[k], kSightingsAKind)) {
      const Pairs pairs = pairs_of(scene, sighting.labels);
      for (const SketchFit& fit : sketches(pairs.points, pairs.pixels, prior, kPatchScale_px, 2)) {
        const Growth growth = grow(scene, survey, fit.sketch, prior, sighting.labels);
        ++grown;
        if (growth.labelled < kLeastToTell || growth.log_odds < 20.0) continue;
        std::vector<Growth> all = likenesses(scene, survey, prior, kinds, growth, kLikeMargin);
        if (convincing(scene, all.front())) return all;
      }
      if (grown >= kMostGrown) break;
    }
  }
  return {};
}

}  // namespace dottrack::calibrate
