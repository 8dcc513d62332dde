#include "app/workstation/calibrate/fit/calibration.h"

#include <fmt/format.h>

#include <atomic>
#include <thread>

#include "app/workstation/calibrate/fit/editing.h"
#include "app/workstation/calibrate/fit/hold_out.h"
#include "app/workstation/calibrate/fit/model_choice.h"
#include "app/workstation/calibrate/fit/results.h"
#include "app/workstation/calibrate/fit/setup.h"

namespace dottrack::calibrate {
namespace {

constexpr double kChosen = 0.6;  // of the work
constexpr double kAdjusted = 0.8;

// Asks whether to go on, and remembers the answer. The thread that made it is the one that asks.
class Progress {
 public:
  explicit Progress(const CalibrationOptions& options) : options_(options) {}

  bool at(double part, const std::string& what) {
    const bool ask = !stopped_ && options_.progress && std::this_thread::get_id() == asker_;
    if (ask && !options_.progress(part, what)) stopped_ = true;
    return !stopped_;
  }

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

Adjustment together(std::span<const CameraViews> views, std::span<const Choice> choices,
                    std::vector<AdjustedDot> dots) {
  Adjustment out;
  out.dots = std::move(dots);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    out.cameras.push_back(choices[i].camera);
    const std::vector<View> own = views_of(views[i], i);
    out.views.insert(out.views.end(), own.begin(), own.end());
  }
  return out;
}

Result<Calibration> stopped() {
  return fail("calibration interrupted");
}

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
  const auto go_on = [&](double part) { return progress.at(kChosen * part, "choosing models"); };
  const auto choices = choose({views, *cameras, survey, options, go_on});
  if (!choices) return tl::unexpected(choices.error());
  if (!progress.at(kChosen, "adjusting all cameras together")) return stopped();
  Adjustment adjustment = together(views, *choices, survey);
  const auto information = adjust_and_edit(adjustment, options.estimate_noise);
  if (!information) {
    return fail("the cameras cannot be adjusted together: the dots do not determine them");
  }
  if (!progress.at(kAdjusted, "testing on dots left out")) return stopped();
  const HeldOut held_out = hold_out(adjustment, options.folds, options.threads);
  progress.at(1.0, "done");
  return results_of(dots, views, {adjustment, *information, held_out, *choices});
}

}  // namespace dottrack::calibrate
