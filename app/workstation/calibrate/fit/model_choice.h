#pragma once
// Which kind of model each camera gets: the simplest that foretells views it was not fitted to as
// well as the best does, within the noise. All cameras are adjusted together for that, so that a
// dot whose view is left out is known from other cameras better than from its survey.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/calibrate/fit/adjustment.h"
#include "app/workstation/calibrate/fit/calibration.h"
#include "app/workstation/calibrate/fit/setup.h"

namespace dottrack::calibrate {

// The kinds to choose from, the simplest first.
std::vector<LensKind> candidates(ModelKind kind);
ModelKind kind_of(const LensKind& kind);
std::string words_of(const LensKind& kind);

struct TriedKind {
  LensKind kind;
  double holdout_rms_px = 0.0;  // of left-out views, the far ones cut; infinite: does not work
  bool chosen = false;
};

struct Choice {
  AdjustedCamera camera;
  std::vector<TriedKind> tried;  // empty where there was no choice
};

struct ChoiceSetup {
  std::span<const CameraViews> views;
  std::span<const StartedCamera> cameras;
  std::span<const AdjustedDot> dots;  // as surveyed
  CalibrationOptions options;
  // How far it is, 0 to 1, by the thread that called; false: give up.
  std::function<bool(double)> go_on;
};

// Of each camera. Errors name the camera that no candidate fits.
Result<std::vector<Choice>> choose(const ChoiceSetup& setup);

// Which fold a dot is in: neighbours in the file are in different ones.
inline std::size_t fold_of(std::size_t dot, std::size_t folds) {
  return dot % folds;
}

}  // namespace dottrack::calibrate
