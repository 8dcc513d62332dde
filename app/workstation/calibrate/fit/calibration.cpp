#include "app/workstation/calibrate/fit/calibration.h"

#include <fmt/format.h>

#include <atomic>
#include <optional>
#include <thread>

#include "app/workstation/calibrate/fit/editing.h"
#include "app/workstation/calibrate/fit/hold_out.h"
#include "app/workstation/calibrate/fit/model_choice.h"
#include "app/workstation/calibrate/fit/parallel.h"
#include "app/workstation/calibrate/fit/results.h"
#include "app/workstation/calibrate/fit/setup.h"

namespace dottrack::calibrate {
namespace {

constexpr double kChosen = 0.6;    // of the work
constexpr double kAdjusted = 0.8;

// Asks whether to go on, and remembers the answer. The thread that made it is the one that asks.
class Progress {
 public:
  explicit Progress(const CalibrationOptions& options) : options_(options) {}

  bool at(double part, const std::string& what) {
    const bool ask = options_.progress && std::this_thread::get_id() == asker_;
    if (ask && !options_.progress(part, what)) stopped_ = true;
    return !stopped_;
  }
  bool stopped() const { return stopped_; }

 private:
  const CalibrationOptions& options_;
  std::thread::id asker_ = std::this_thread::get_id();
  std::atomic<bool> stopped_{false};
};

Result<std::vector<StartedCamera>> start_all(std::span<const SurveyedDot> dots,
                                             std::span<const CameraViews> views) {
  std::vector<StartedCamera> cameras;
  for (const CameraViews& v : views) {
    auto camera = started(dots, v);
    if (!camera) return tl::unexpected(camera.error());
    cameras.push_back(*camera);
  }
  if (const auto agreed = check_handedness(views, cameras); !agreed) {
    return tl::unexpected(agreed.error());
  }
  return cameras;
}

std::vector<std::optional<Choice>> choose_all(std::span<const CameraViews> views,
                                              std::span<const StartedCamera> cameras,
                                              std::span<const AdjustedDot> dots,
                                              const CalibrationOptions& options,
                                              Progress& progress) {
  const std::vector<LensKind> kinds = candidates(options.kind);
  std::vector<std::optional<Choice>> choices(cameras.size());
  std::atomic<std::size_t> done{0};
  for_each_index(cameras.size(), options.threads, [&](std::size_t i) {
    if (progress.stopped()) return;
    const std::uint64_t seed = options.seed == 0 ? 0 : options.seed + 7919 * i;
    choices[i] = choose(cameras[i], views_of(views[i], 0), kinds, {dots, options.folds, seed});
    progress.at(kChosen * static_cast<double>(++done) / static_cast<double>(cameras.size()),
                "choosing models");
  });
  return choices;
}

Adjustment together(std::span<const CameraViews> views, std::span<const StartedCamera> cameras,
                    std::span<const std::optional<Choice>> choices,
                    std::vector<AdjustedDot> dots) {
  Adjustment out;
  out.dots = std::move(dots);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    AdjustedCamera camera = prepared(cameras[i], choices[i]->kind, 0);
    camera.camera = choices[i]->camera;
    out.cameras.push_back(camera);
    const std::vector<View> own = views_of(views[i], i);
    out.views.insert(out.views.end(), own.begin(), own.end());
  }
  return out;
}

Result<Calibration> stopped() { return fail("calibration interrupted"); }

}  // namespace

std::string_view to_string(ModelKind kind) {
  switch (kind) {
    case ModelKind::automatic:
      return "automatic";
    case ModelKind::cahv:
      return "CAHV";
    case ModelKind::cahv_radial:
      return "CAHV with one radial term";
    case ModelKind::cahvor:
      return "CAHVOR";
    case ModelKind::cahvore:
      return "CAHVORE";
  }
  return "";
}

Result<Calibration> calibrate(std::span<const SurveyedDot> dots, std::span<const CameraViews> views,
                              const CalibrationOptions& options) {
  if (views.empty()) return fail("no camera to calibrate");
  const auto cameras = start_all(dots, views);
  if (!cameras) return tl::unexpected(cameras.error());
  Progress progress(options);
  const auto survey = surveyed(dots, options.default_survey_sigma_m);
  const auto choices = choose_all(views, *cameras, survey, options, progress);
  if (progress.stopped()) return stopped();
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i]) continue;
    return fail(fmt::format("camera {}: no model fits its {} dots: their labels are wrong, or it "
                            "saw too few",
                            views[i].name, views[i].observations.size()));
  }
  if (!progress.at(kChosen, "adjusting all cameras together")) return stopped();
  Adjustment adjustment = together(views, *cameras, choices, survey);
  const auto information = adjust_and_edit(adjustment, options.estimate_noise);
  if (!information) {
    return fail("the cameras cannot be adjusted together: the dots do not determine them");
  }
  if (!progress.at(kAdjusted, "testing on dots left out")) return stopped();
  const HeldOut held_out = hold_out(adjustment, options.folds, options.threads);
  progress.at(1.0, "done");
  std::vector<Choice> chosen;
  for (const auto& choice : choices) chosen.push_back(*choice);
  return results_of(dots, views, {adjustment, *information, held_out, chosen});
}

}  // namespace dottrack::calibrate
