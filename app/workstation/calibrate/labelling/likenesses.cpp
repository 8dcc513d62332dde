#include "app/workstation/calibrate/labelling/likenesses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dottrack::calibrate {
namespace {

constexpr double kSamePlace = 0.2;  // of the spacing
constexpr double kCarried = 0.4;    // of the labelled dots, at least
constexpr std::size_t kSample = 40;
constexpr std::size_t kMostMatched = 60;
constexpr std::size_t kMostSettled = 12;
constexpr int kMostClimbs = 8;

Eigen::Matrix3d frame_of(const Scene& scene, const PatchKind::Place& at) {
  const auto place = [&](int dot) -> const Eigen::Vector3d& {
    return scene.dots[static_cast<std::size_t>(dot)].position_m;
  };
  const Eigen::Vector3d e = place(at.first) - place(at.dot);
  Eigen::Matrix3d frame;
  frame.col(0) = e.normalized();
  frame.col(2) = e.cross(place(at.second) - place(at.dot)).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

struct Reference {
  const PatchKind* kind = nullptr;
  PatchKind::Place place = {};
};

// A labelled patch of the commonest kind.
Reference reference_of(const std::vector<PatchKind>& kinds, const Labels& labels) {
  const auto labelled = [&](int dot) { return labels[static_cast<std::size_t>(dot)] != kNoBlob; };
  for (const PatchKind& kind : kinds) {
    for (const PatchKind::Place& at : kind.places) {
      if (labelled(at.dot) && labelled(at.first) && labelled(at.second)) return {&kind, at};
    }
  }
  return {};
}

bool carries_enough(const Scene& scene, const SurveyIndex& survey, const std::vector<int>& dots,
                    const Likeness& motion) {
  const std::size_t step = std::max<std::size_t>(1, dots.size() / kSample);
  std::size_t tried = 0;
  std::size_t carried = 0;
  for (std::size_t i = 0; i < dots.size(); i += step, ++tried) {
    const auto dot = static_cast<std::size_t>(dots[i]);
    const Eigen::Vector3d there =
        motion.rotation * scene.dots[dot].position_m + motion.translation_m;
    const double within = kSamePlace * survey.spacing_m(dots[i]);
    carried += survey.at(scene.dot_layer[dot], there, within) >= 0 ? 1U : 0U;
  }
  return static_cast<double>(carried) >= kCarried * static_cast<double>(tried);
}

// Motions that carry many of the labelled dots onto others.
std::vector<Likeness> motions(const Scene& scene, const SurveyIndex& survey,
                              const std::vector<PatchKind>& kinds, const Labels& labels) {
  const Reference reference = reference_of(kinds, labels);
  std::vector<Likeness> found;
  if (reference.kind == nullptr) return found;
  std::vector<int> dots;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != kNoBlob) dots.push_back(static_cast<int>(i));
  }
  const Eigen::Matrix3d from = frame_of(scene, reference.place);
  const auto& start = scene.dots[static_cast<std::size_t>(reference.place.dot)].position_m;
  for (const PatchKind::Place& at : reference.kind->places) {
    Likeness motion;
    motion.rotation = frame_of(scene, at) * from.transpose();
    motion.translation_m =
        scene.dots[static_cast<std::size_t>(at.dot)].position_m - motion.rotation * start;
    const bool still = (motion.rotation - Eigen::Matrix3d::Identity()).norm() < 0.01 &&
                       motion.translation_m.norm() < 0.1 * survey.typical_spacing_m();
    if (!still && carries_enough(scene, survey, dots, motion)) found.push_back(motion);
  }
  return found;
}

// The motions after which most blobs are found, of a sample of dots.
std::vector<Likeness> promising(const Scene& scene, const Growth& from,
                                const std::vector<Likeness>& all) {
  if (all.size() <= kMostMatched) return all;
  const double within = std::max(4.0, 4.0 * from.spread_px);
  const std::size_t step = std::max<std::size_t>(1, scene.dots.size() / (4 * kSample));
  std::vector<std::pair<int, std::size_t>> scores;  // misses less hits, motion
  for (std::size_t m = 0; m < all.size(); ++m) {
    const Sketch sketch = moved(from.sketch, all[m]);
    int score = 0;
    for (std::size_t i = 0; i < scene.dots.size(); i += step) {
      const auto at = seen_at(scene, sketch, static_cast<int>(i));
      if (scene.dot_layer[i] < 0 || !at) continue;
      score += scene.index.nearest(scene.dot_layer[i], *at, within) < 0 ? 1 : -3;
    }
    scores.emplace_back(score, m);
  }
  std::sort(scores.begin(), scores.end());
  std::vector<Likeness> best;
  for (std::size_t i = 0; i < kMostMatched; ++i) best.push_back(all[scores[i].second]);
  return best;
}

bool higher(const Growth& a, const Growth& b) {
  return a.log_odds > b.log_odds;
}

std::vector<Growth> carried(const Scene& scene, const SurveyIndex& survey, const SketchPrior& prior,
                            const std::vector<PatchKind>& kinds, const Growth& from) {
  const double within = std::max(4.0, 4.0 * from.spread_px);
  const Labels none(scene.dots.size(), kNoBlob);
  std::vector<Growth> rough;
  for (const Likeness& motion :
       promising(scene, from, motions(scene, survey, kinds, from.labels))) {
    Growth other{moved(from.sketch, motion), none, 0.0, 0.0, 0, 0};
    other.labels = match(scene, survey, other.sketch, none, within);
    judge(scene, other);
    rough.push_back(std::move(other));
  }
  std::stable_sort(rough.begin(), rough.end(), higher);
  if (rough.size() > kMostSettled) rough.resize(kMostSettled);
  for (Growth& other : rough) {
    other = settle(scene, survey, other.sketch, prior, other.labels, within);
  }
  std::stable_sort(rough.begin(), rough.end(), higher);
  return rough;
}

bool same_labels(const Labels& a, const Labels& b) {
  std::size_t same = 0;
  std::size_t either = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == kNoBlob && b[i] == kNoBlob) continue;
    ++either;
    same += a[i] == b[i] ? 1U : 0U;
  }
  return 2 * same > either;
}

}  // namespace

Sketch moved(const Sketch& sketch, const Likeness& motion) {
  Sketch next = sketch;
  next.rotation = sketch.rotation * motion.rotation.transpose();
  next.translation_m = sketch.translation_m - next.rotation * motion.translation_m;
  return next;
}

std::vector<Growth> likenesses(const Scene& scene, const SurveyIndex& survey,
                               const SketchPrior& prior, const std::vector<PatchKind>& kinds,
                               const Growth& labelling, double margin) {
  Growth best = labelling;
  std::vector<Growth> others;
  for (int climb = 0; climb < kMostClimbs; ++climb) {
    others = carried(scene, survey, prior, kinds, best);
    if (others.empty() ||
        !(others.front().log_odds > best.log_odds + 1e-6 * static_cast<double>(best.labelled)))
      break;
    const bool much = others.front().log_odds > best.log_odds + margin;
    std::swap(best, others.front());
    if (!much) break;
  }
  std::vector<Growth> kept{best};
  for (Growth& other : others) {
    if (other.log_odds < best.log_odds - margin) continue;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Growth& k) {
      return same_labels(k.labels, other.labels);
    });
    if (!known) kept.push_back(std::move(other));
  }
  std::stable_sort(kept.begin(), kept.end(), higher);
  return kept;
}

}  // namespace dottrack::calibrate
