#include "app/workstation/calibrate/labelling/camera_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/workstation/calibrate/labelling/from_scratch.h"
#include "app/workstation/calibrate/labelling/guided.h"
#include "app/workstation/calibrate/labelling/likenesses.h"
#include "app/workstation/calibrate/labelling/sketch_start.h"

namespace dottrack::calibrate {
namespace {

constexpr double kLikeMargin = 12.0;

// Dots in a pattern that repeats tell where they are by themselves.
bool is_grid(const std::vector<PatchKind>& kinds, std::size_t dots) {
  return !kinds.empty() && kinds.front().places.size() >= std::max<std::size_t>(30, dots / 2);
}

std::vector<Growth> sure_ones(const Scene& scene, const SurveyIndex& survey,
                              const SketchPrior& prior, const std::vector<PatchKind>& kinds,
                              std::vector<Growth> labellings) {
  if (labellings.empty() || !convincing(scene, labellings.front())) return {};
  if (labellings.size() > 1) return labellings;
  return likenesses(scene, survey, prior, kinds, labellings.front(), kLikeMargin);
}

}  // namespace

SketchPrior prior_of(const CameraInput& input, int width_px, int height_px,
                     const GuessTolerance& tolerance) {
  SketchPrior prior = any_camera(width_px, height_px);
  if (input.approximate) {
    prior.about = as_sketch(*input.approximate);
    prior.place_m = tolerance.place_m;
    prior.rotation_rad = tolerance.rotation_rad;
    prior.log_focal = tolerance.log_focal;
    prior.centre_px = 0.05 * width_px;
  } else if (input.near_m) {
    prior.about.focal_px = 0.9 * width_px;
    prior.log_focal = 0.8;
    prior.centre_px = 0.05 * width_px;
    prior.place_m = tolerance.place_m;
    prior.about.translation_m = -*input.near_m;
  }
  return prior;
}

Result<Scene> scene_of(std::span<const SurveyedDot> dots, const CameraPictures& pictures,
                       const BlobOptions& options) {
  Scene scene;
  scene.dots = dots;
  auto mean = mean_picture(pictures.files);
  if (!mean) return tl::unexpected<Error>(mean.error());
  scene.width_px = mean->width_px;
  scene.height_px = mean->height_px;
  std::map<std::size_t, int> layers;
  std::vector<int> layer_of_blob;
  const auto add = [&](const Picture& picture, int layer) {
    for (Blob& blob : find_blobs(picture.view(), options)) {
      scene.blobs.push_back(blob);
      layer_of_blob.push_back(layer);
    }
  };
  add(*mean, 0);
  for (const SurveyedDot& dot : dots) {
    int layer = 0;
    if (dot.tick) {
      const auto file = pictures.of_tick.find(*dot.tick);
      const auto known = layers.find(*dot.tick);
      layer = known != layers.end() ? known->second : -1;
      if (known == layers.end() && file != pictures.of_tick.end()) {
        const auto picture = read_picture(file->second);
        if (!picture) return tl::unexpected<Error>(picture.error());
        layer = static_cast<int>(layers.size()) + 1;
        layers[*dot.tick] = layer;
        add(*picture, layer);
      }
    }
    scene.dot_layer.push_back(layer);
  }
  std::vector<Eigen::Vector2d> pixels;
  for (const Blob& blob : scene.blobs) pixels.push_back(blob.pixel);
  scene.index = BlobIndex(pixels, layer_of_blob, scene.width_px, scene.height_px);
  return scene;
}

std::vector<Growth> labels_from_seeds(const Scene& scene, const SurveyIndex& survey,
                                      const SketchPrior& prior, std::span<const Seed> seeds) {
  constexpr double kPointing_px = 3.0;
  const double pointing_px = std::max(6.0, 0.02 * scene.width_px);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  Labels labels(scene.dots.size(), kNoBlob);
  for (const Seed& seed : seeds) {
    points.push_back(scene.dots[seed.dot].position_m);
    const int layer = scene.dot_layer[seed.dot];
    const int blob = scene.index.nearest(layer, seed.pixel, pointing_px);
    labels[seed.dot] = blob;
    pixels.push_back(blob < 0 ? seed.pixel : scene.blobs[static_cast<std::size_t>(blob)].pixel);
  }
  std::vector<Growth> grown;
  for (const SketchFit& fit : sketches(points, pixels, prior, kPointing_px, 8)) {
    grown.push_back(grow(scene, survey, fit.sketch, prior, labels));
    const Labels none(scene.dots.size(), kNoBlob);
    grown.push_back(settle(scene, survey, fit.sketch, prior, none, 0.03 * scene.width_px));
  }
  std::stable_sort(grown.begin(), grown.end(),
                   [](const Growth& a, const Growth& b) { return a.log_odds > b.log_odds; });
  std::erase_if(grown, [&](const Growth& growth) {  // what was pointed at stays what it is
    std::size_t kept = 0;
    for (const Seed& seed : seeds) {
      const auto at = project(growth.sketch, scene.dots[seed.dot].position_m);
      kept += at && (*at - seed.pixel).norm() < pointing_px ? 1U : 0U;
    }
    return 4 * kept < 3 * seeds.size();
  });
  if (grown.size() > 1) grown.resize(1);
  return grown;
}

std::vector<Growth> label_camera(const Scene& scene, const SurveyIndex& survey,
                                 const CameraInput& input) {
  const SketchPrior any = any_camera(scene.width_px, scene.height_px);
  if (!input.seeds.empty()) {
    auto labels = labels_from_seeds(scene, survey, any, input.seeds);
    if (labels.empty() || !convincing(scene, labels.front())) return {};
    return labels;
  }
  const std::vector<PatchKind> kinds = patch_kinds(scene, survey);
  const bool guess = input.approximate || input.near_m;
  const bool grid = is_grid(kinds, scene.dots.size());
  if (grid || !guess) {
    auto labels = labels_from_scratch(scene, survey, any);
    if (!labels.empty() || !guess) return labels;
  }
  const SketchPrior prior = prior_of(input, scene.width_px, scene.height_px);
  auto labels = sure_ones(scene, survey, prior, kinds, labels_from_guess(scene, survey, prior));
  if (!labels.empty() || grid) return labels;
  return labels_from_scratch(scene, survey, any);
}

}  // namespace dottrack::calibrate
