#include "app/workstation/calibrate/labelling/growth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace dottrack::calibrate {
namespace {

constexpr double kOfSpacing = 0.33;  // how far a blob may be off, of the way to the next dot
constexpr double kLeastTolerance_px = 2.0;
constexpr double kChance = 0.35;   // blobs expected inside the tolerance by chance
constexpr double kDetected = 0.7;  // how probably a dot that is there is found
constexpr double kLeastSigma_px = 0.3;
constexpr double kGrazing = 0.05;  // cosine
constexpr int kMaxRounds = 40;

double widest_tolerance(const Scene& scene) {
  double densest = 1e-9;
  for (std::size_t layer = 0; layer < scene.index.layers(); ++layer) {
    densest = std::max(densest, scene.index.density(static_cast<int>(layer)));
  }
  return std::max(kLeastTolerance_px, std::sqrt(kChance / (std::numbers::pi * densest)));
}

using Places = std::vector<std::optional<Eigen::Vector2d>>;

Places places_of(const Scene& scene, const Sketch& sketch) {
  Places places(scene.dots.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (scene.dot_layer[i] >= 0) places[i] = seen_at(scene, sketch, static_cast<int>(i));
  }
  return places;
}

class Matcher {
 public:
  Matcher(const Scene& scene, const SurveyIndex& survey, const Sketch& sketch, const Labels& known)
      : scene_(scene), survey_(survey), known_(known), places_(places_of(scene, sketch)) {}

  // Each blob to the dot that is nearest to it.
  Labels match(std::span<const int> dots, double within_px) const {
    Labels labels(scene_.dots.size(), kNoBlob);
    std::vector<std::pair<double, int>> owner(scene_.blobs.size(), {0.0, -1});
    for (const int dot : dots) {
      const auto i = static_cast<std::size_t>(dot);
      if (!places_[i]) continue;
      const Eigen::Vector2d at = *places_[i] + shift_of(dot);
      const double reach = std::min(within_px, kOfSpacing * room_of(dot));
      const int blob = scene_.index.nearest(scene_.dot_layer[i], at, reach);
      if (blob < 0) continue;
      const auto b = static_cast<std::size_t>(blob);
      const double off = (scene_.blobs[b].pixel - at).squaredNorm();
      auto& [least, holder] = owner[b];
      if (holder >= 0 && least <= off) continue;
      if (holder >= 0) labels[static_cast<std::size_t>(holder)] = kNoBlob;
      least = off;
      holder = dot;
      labels[i] = blob;
    }
    return labels;
  }

 private:
  // How far its labelled neighbours are off: what the sketch does not know of the lens.
  Eigen::Vector2d shift_of(int dot) const {
    constexpr int kEnough = 4;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int n = 0;
    for (const int other : survey_.neighbours(dot)) {
      const auto o = static_cast<std::size_t>(other);
      if (known_[o] == kNoBlob || !places_[o]) continue;
      sum += scene_.blobs[static_cast<std::size_t>(known_[o])].pixel - *places_[o];
      ++n;
    }
    return n >= kEnough ? Eigen::Vector2d(sum / n) : Eigen::Vector2d::Zero();
  }

  double room_of(int dot) const {
    double room = std::numeric_limits<double>::infinity();
    for (const int other : survey_.neighbours(dot)) {
      const auto o = static_cast<std::size_t>(other);
      if (!places_[o]) continue;
      room = std::min(room, (*places_[o] - *places_[static_cast<std::size_t>(dot)]).norm());
    }
    return room;
  }

  const Scene& scene_;
  const SurveyIndex& survey_;
  const Labels& known_;
  Places places_;
};

std::vector<int> all_dots(const Scene& scene) {
  std::vector<int> dots;
  for (std::size_t i = 0; i < scene.dots.size(); ++i) {
    if (scene.dot_layer[i] >= 0) dots.push_back(static_cast<int>(i));
  }
  return dots;
}

// Dots by how many steps from neighbour to neighbour they are from a labelled one.
std::vector<int> by_distance(const Scene& scene, const SurveyIndex& survey, const Labels& labels) {
  std::vector<int> order;
  std::vector<bool> reached(labels.size(), false);
  const auto take = [&](std::size_t dot) {
    if (reached[dot] || scene.dot_layer[dot] < 0) return;
    reached[dot] = true;
    order.push_back(static_cast<int>(dot));
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != kNoBlob) take(i);
  }
  for (std::size_t next = 0; next < order.size(); ++next) {
    for (const int other : survey.neighbours(order[next])) take(static_cast<std::size_t>(other));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) take(i);
  return order;
}

void refit(const Scene& scene, const SketchPrior& prior, Growth& growth, int steps) {
  const Pairs pairs = pairs_of(scene, growth.labels);
  const double scale = std::max(0.7, 2.0 * growth.spread_px);
  const SketchFit fit = fit_sketch(growth.sketch, prior, pairs.points, pairs.pixels, scale, steps);
  growth.sketch = fit.sketch;
  growth.spread_px = fit.spread_px;
}

double tolerance_of(const Growth& growth, double widest_px) {
  return std::clamp(6.0 * growth.spread_px, kLeastTolerance_px, widest_px);
}

}  // namespace

std::optional<Eigen::Vector2d> seen_at(const Scene& scene, const Sketch& sketch, int dot) {
  const SurveyedDot& d = scene.dots[static_cast<std::size_t>(dot)];
  const auto pixel = project(sketch, d.position_m);
  if (!pixel || !scene.holds(*pixel)) return std::nullopt;
  if (d.normal) {
    const Eigen::Vector3d to_camera = (sketch.place_m() - d.position_m).normalized();
    if (to_camera.dot(*d.normal) < kGrazing) return std::nullopt;
  }
  return pixel;
}

Pairs pairs_of(const Scene& scene, const Labels& labels) {
  Pairs pairs;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoBlob) continue;
    pairs.points.push_back(scene.dots[i].position_m);
    pairs.pixels.push_back(scene.blobs[static_cast<std::size_t>(labels[i])].pixel);
  }
  return pairs;
}

Labels match(const Scene& scene, const SurveyIndex& survey, const Sketch& sketch,
             const Labels& known, double within_px) {
  return Matcher(scene, survey, sketch, known).match(all_dots(scene), within_px);
}

void judge(const Scene& scene, Growth& growth) {
  std::vector<double> squares;
  growth.expected = 0;
  growth.log_odds = 0.0;
  std::vector<std::pair<double, int>> found;  // squared distance, layer
  std::size_t missed = 0;
  for (std::size_t i = 0; i < growth.labels.size(); ++i) {
    if (scene.dot_layer[i] < 0) continue;
    const auto at = seen_at(scene, growth.sketch, static_cast<int>(i));
    if (!at) continue;
    ++growth.expected;
    if (growth.labels[i] == kNoBlob) {
      ++missed;
      continue;
    }
    const auto& blob = scene.blobs[static_cast<std::size_t>(growth.labels[i])];
    found.emplace_back((blob.pixel - *at).squaredNorm(), scene.dot_layer[i]);
    squares.push_back(found.back().first);
  }
  growth.labelled = found.size();
  if (found.empty()) return;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  growth.spread_px = std::sqrt(*middle);
  const double sigma = std::max(kLeastSigma_px, growth.spread_px / 1.1774);
  for (const auto& [squared, layer] : found) {
    const double here =
        std::exp(-0.5 * squared / (sigma * sigma)) / (2.0 * std::numbers::pi * sigma * sigma);
    growth.log_odds += std::log(kDetected * here / scene.index.density(layer) + (1.0 - kDetected));
  }
  growth.log_odds += static_cast<double>(missed) * std::log(1.0 - kDetected);
}

bool convincing(const Scene& scene, const Growth& growth) {
  const double hypotheses =
      static_cast<double>(scene.dots.size()) * static_cast<double>(scene.blobs.size()) * 1e3;
  constexpr double kNarrowest = 40.0;  // focal length in widths: a lens of 1.4 degrees
  constexpr double kLoosest = 0.004;   // spread, of the image's width
  return growth.labelled >= kLeastToTell && growth.spread_px < kLoosest * scene.width_px &&
         growth.sketch.focal_px < kNarrowest * scene.width_px &&
         growth.log_odds > 10.0 + std::log(hypotheses) && 2 * growth.labelled > growth.expected;
}

Growth settle(const Scene& scene, const SurveyIndex& survey, const Sketch& start,
              const SketchPrior& prior, const Labels& labels, double within_px) {
  Growth growth{start, labels, within_px / 6.0, 0.0, 0, 0};
  double tolerance = within_px;
  const double widest = std::max(within_px, widest_tolerance(scene));
  for (int round = 0; round < 12; ++round) {
    Labels next = match(scene, survey, growth.sketch, growth.labels, tolerance);
    const bool same = next == growth.labels;
    growth.labels = std::move(next);
    if (count(growth.labels) < 4 || (same && round > 1)) break;
    refit(scene, prior, growth, 10);
    tolerance = std::min(0.8 * tolerance, tolerance_of(growth, widest));
    tolerance = std::max(tolerance, tolerance_of(growth, widest) * 0.8);
  }
  judge(scene, growth);
  return growth;
}

Growth grow(const Scene& scene, const SurveyIndex& survey, const Sketch& start,
            const SketchPrior& prior, const Labels& labels) {
  Growth growth{start, labels, 0.5, 0.0, count(labels), 0};
  const double widest = widest_tolerance(scene);
  const std::size_t all = all_dots(scene).size();
  std::size_t reach = std::max<std::size_t>(8, 2 * growth.labelled);
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::vector<int> order = by_distance(scene, survey, growth.labels);
    const std::span<const int> tried(order.data(), std::min(reach, order.size()));
    growth.labels = Matcher(scene, survey, growth.sketch, growth.labels)
                        .match(tried, tolerance_of(growth, widest));
    growth.labelled = count(growth.labels);
    if (growth.labelled < 4) break;
    refit(scene, prior, growth, 6);
    if (tried.size() == all) break;
    reach = std::max(reach + reach / 2, 2 * growth.labelled);
  }
  if (growth.labelled < 4) {
    judge(scene, growth);
    return growth;
  }
  return settle(scene, survey, growth.sketch, prior, growth.labels, tolerance_of(growth, widest));
}

}  // namespace dottrack::calibrate
