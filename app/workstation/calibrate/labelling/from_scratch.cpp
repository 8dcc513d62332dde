#include "app/workstation/calibrate/labelling/from_scratch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/workstation/calibrate/labelling/likenesses.h"
#include "app/workstation/calibrate/labelling/sketch_start.h"

namespace dottrack::calibrate {
namespace {

constexpr std::size_t kSightingsAKind = 60;
constexpr std::size_t kKinds = 400;
constexpr std::size_t kMostGrown = 600;
constexpr std::size_t kDotsGrown = 260000;  // all in all: many dots grow slowly, and need few tries
constexpr std::size_t kGrownAfterFirst = 300;  // a finer grid may look like a part of itself
constexpr double kLikeMargin = 12.0;
constexpr double kWorthwhile = 20.0;  // log odds

// Nothing better can come.
bool nearly_all(const Scene& scene, const Growth& growth) {
  constexpr double kExact = 0.0015;  // of the image's width
  return growth.spread_px < kExact * scene.width_px && 5 * growth.labelled > 4 * growth.expected &&
         5 * growth.expected > growth.labels.size();
}

// Fitted anew from other starts: what grew may have come to rest beside the best fit.
std::vector<Growth> polished(const Scene& scene, const SurveyIndex& survey,
                             const SketchPrior& prior, std::vector<Growth> labellings) {
  for (Growth& growth : labellings) {
    const Pairs pairs = pairs_of(scene, growth.labels);
    const double scale = std::max(0.7, 2.0 * growth.spread_px);
    for (const SketchFit& fit : sketches(pairs.points, pairs.pixels, prior, scale, 1)) {
      Growth other = settle(scene, survey, fit.sketch, prior, growth.labels, 4.0 * scale);
      if (other.log_odds > growth.log_odds) growth = std::move(other);
    }
  }
  return labellings;
}

}  // namespace

std::vector<Growth> labels_from_scratch(const Scene& scene, const SurveyIndex& survey,
                                        const SketchPrior& prior) {
  constexpr double kPatchScale_px = 1.0;
  const std::vector<PatchKind> kinds = patch_kinds(scene, survey);
  std::vector<Growth> best;
  std::size_t left = std::clamp<std::size_t>(
      kDotsGrown / std::max<std::size_t>(scene.dots.size(), 1), 60, kMostGrown);
  for (std::size_t k = 0; k < std::min(kKinds, kinds.size()) && left > 0; ++k) {
    for (const Sighting& sighting : sightings(scene, kinds[k], kSightingsAKind)) {
      const Pairs pairs = pairs_of(scene, sighting.labels);
      for (const SketchFit& fit : sketches(pairs.points, pairs.pixels, prior, kPatchScale_px, 2)) {
        const Growth growth = grow(scene, survey, fit.sketch, prior, sighting.labels);
        if (left > 0) --left;
        if (growth.labelled < kLeastToTell || growth.log_odds < kWorthwhile) continue;
        if (!best.empty() && growth.log_odds < 0.2 * best.front().log_odds) continue;
        std::vector<Growth> all = likenesses(scene, survey, prior, kinds, growth, kLikeMargin);
        if (!convincing(scene, all.front())) continue;
        if (nearly_all(scene, all.front())) return polished(scene, survey, prior, std::move(all));
        if (best.empty() || all.front().log_odds > best.front().log_odds) {
          if (best.empty()) left = std::min(left, kGrownAfterFirst);
          best = std::move(all);
        }
      }
      if (left == 0) break;
    }
  }
  return polished(scene, survey, prior, std::move(best));
}

}  // namespace dottrack::calibrate
