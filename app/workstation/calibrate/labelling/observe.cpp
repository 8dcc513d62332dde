#include "app/workstation/calibrate/labelling/observe.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "app/config/complaint.h"
#include "app/workstation/calibrate/fit/parallel.h"
#include "app/workstation/calibrate/labelling/agreement.h"
#include "app/workstation/calibrate/labelling/diagnosis.h"
#include "app/workstation/calibrate/labelling/eccentricity.h"

namespace dottrack::calibrate {
namespace {

class Labeller {
 public:
  Labeller(std::span<const SurveyedDot> dots, const std::vector<CameraInput>& inputs,
           const ObserveOptions& options)
      : dots_(dots),
        inputs_(inputs),
        options_(options),
        cameras_(inputs.size()),
        faults_(inputs.size()) {}

  std::vector<LabelledCamera>& cameras() { return cameras_; }

  // An error of a file.
  Result<void> run() {
    for_each_index(inputs_.size(), options_.threads, [&](std::size_t c) {
      label(c);
      const std::lock_guard lock(mutex_);
      ++done_;
      if (options_.progress) {
        options_.progress(static_cast<double>(done_) / static_cast<double>(inputs_.size()));
      }
    });
    for (const std::string& fault : faults_) {
      if (!fault.empty()) return fail(fault);
    }
    return {};
  }

 private:
  void label(std::size_t c) {
    label_as(c, options_.blobs, cameras_[c]);
    if (!options_.either_polarity || beyond_doubt(cameras_[c])) return;
    BlobOptions dark = options_.blobs;
    dark.polarity = core::Polarity::dark;
    LabelledCamera other;
    label_as(c, dark, other);
    const bool better = !other.labellings.empty() && (cameras_[c].labellings.empty() ||
                                                      other.labellings.front().log_odds >
                                                          cameras_[c].labellings.front().log_odds);
    if (better) cameras_[c] = std::move(other);
  }

  // The gaps between dark dots are a bright grid too, though not as good a one.
  static bool beyond_doubt(const LabelledCamera& camera) {
    if (camera.labellings.empty()) return false;
    const Growth& best = camera.labellings.front();
    return 5 * best.labelled > 4 * best.expected && best.spread_px < 1.0;
  }

  void label_as(std::size_t c, const BlobOptions& blobs, LabelledCamera& camera) {
    auto scene = scene_of(dots_, inputs_[c].pictures, blobs);
    if (!scene) {
      faults_[c] = scene.error().message;
      return;
    }
    camera.scene = std::move(*scene);
    const SurveyIndex survey(dots_, camera.scene.dot_layer);
    if (camera.scene.blobs.size() < kLeastToTell) return;
    camera.labellings = label_camera(camera.scene, survey, inputs_[c]);
  }

  std::span<const SurveyedDot> dots_;
  const std::vector<CameraInput>& inputs_;
  const ObserveOptions& options_;
  std::vector<LabelledCamera> cameras_;
  std::vector<std::string> faults_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

constexpr double kUnsure = 3.0;  // times as unsure as the others: a glint, a scratch across the rim

double median_sigma_px(const Scene& scene, const Labels& labels) {
  std::vector<double> sigmas;
  for (const int blob : labels) {
    if (blob != kNoBlob) sigmas.push_back(scene.blobs[static_cast<std::size_t>(blob)].sigma_px);
  }
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end());
  return *middle;
}

CameraViews views_of(const CameraInput& input, const LabelledCamera& camera) {
  CameraViews views;
  views.name = input.pictures.name;
  views.width_px = camera.scene.width_px;
  views.height_px = camera.scene.height_px;
  views.near_m = input.near_m;
  const Growth& growth = camera.labellings.front();
  const SurveyIndex survey(camera.scene.dots, camera.scene.dot_layer);
  views.approximate = as_cahvor(growth.sketch);
  const double unsure_px = kUnsure * median_sigma_px(camera.scene, growth.labels);
  for (std::size_t i = 0; i < growth.labels.size(); ++i) {
    if (growth.labels[i] == kNoBlob) continue;
    const Blob& blob = camera.scene.blobs[static_cast<std::size_t>(growth.labels[i])];
    if (blob.sigma_px > unsure_px) continue;
    const Eigen::Vector2d off = eccentricity_px(camera.scene, survey, growth, static_cast<int>(i));
    views.observations.push_back({i, blob.pixel - off, blob.sigma_px});
  }
  return views;
}

Result<void> check_survey(std::span<const SurveyedDot> dots) {
  if (dots.size() >= kLeastToTell) return {};
  return fail(fmt::format("the survey has {} dots; expected {} or more, not all in one plane",
                          dots.size(), kLeastToTell));
}

}  // namespace

Result<Observed> observe(std::span<const SurveyedDot> dots, const std::vector<CameraInput>& inputs,
                         const ObserveOptions& options) {
  if (auto enough = check_survey(dots); !enough) return tl::unexpected<Error>(enough.error());
  Labeller labeller(dots, inputs, options);
  if (auto done = labeller.run(); !done) return tl::unexpected<Error>(done.error());
  std::vector<LabelledCamera>& cameras = labeller.cameras();
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (cameras[c].labellings.empty()) return fail(why_unlabelled(dots, inputs, cameras, c));
  }
  auto remarks = decide(inputs, cameras);
  if (!remarks) return tl::unexpected<Error>(remarks.error());
  if (const auto wrong = why_unbelievable(dots, inputs, cameras)) return fail(*wrong);
  Observed observed;
  observed.remarks = std::move(*remarks);
  const auto mirror = try_mirror(dots, inputs, cameras);
  if (!mirror) return tl::unexpected<Error>(mirror.error());
  if (*mirror) observed.remarks.push_back(**mirror);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    observed.views.push_back(views_of(inputs[c], cameras[c]));
  }
  return observed;
}

}  // namespace dottrack::calibrate
