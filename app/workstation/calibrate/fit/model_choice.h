#pragma once
// Which kind of model a camera gets: the simplest that foretells dots it was not fitted to as well
// as the best does, within the noise.

#include <cstddef>
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

// What the choice needs beyond one camera.
struct ChoiceSetup {
  std::span<const AdjustedDot> dots;  // as surveyed
  std::size_t folds = 10;
  std::uint64_t seed = 0;
};

struct TriedKind {
  LensKind kind;
  double holdout_rms_px = 0.0;  // of left-out dots, the far ones cut; infinite: does not work
  double loss = 0.0;            // mean over dots, squared sigmas
  bool chosen = false;
};

struct Choice {
  LensKind kind;
  NumberedCamera camera;  // fitted to all its views, alone
  std::vector<TriedKind> tried;
};

// Nothing if no candidate can be fitted.
std::optional<Choice> choose(const StartedCamera& camera, std::span<const View> views,
                             std::span<const LensKind> kinds, const ChoiceSetup& setup);

// Which fold a dot is in: neighbours in the file are in different ones.
inline std::size_t fold_of(std::size_t dot, std::size_t folds) { return dot % folds; }

}  // namespace dottrack::calibrate
