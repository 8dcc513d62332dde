#pragma once
// Automatic editing in the sense of the paper's reference [14]: leave out the worst, fit again,
// test again all that is left out and bring back what fits, until nothing changes. Views of dots
// and whole surveyed places are both tested, and what is the better explanation goes.

#include <cstddef>
#include <vector>

#include "app/workstation/calibrate/fit/adjustment.h"
#include "app/workstation/calibrate/fit/information.h"

namespace dottrack::calibrate {

// How improbable what was left out, or would be, is: -log of the probability by chance.
struct Surprises {
  std::vector<double> views;
  std::vector<double> surveys;
};

Surprises surprises(const Adjustment& adjustment, const Information& information);

// Sigmas from the residuals themselves.
struct NoiseOptions {
  bool estimate = true;
  bool robust = false;  // by medians: where much may still be wrong
  bool for_each_camera = true;
};

class Editor {
 public:
  explicit Editor(const Adjustment& adjustment);

  // Changes what is kept and trusted; false where there was nothing to change.
  bool edit(Adjustment& adjustment, const Information& information);

 private:
  bool bring_back(Adjustment& adjustment, const Surprises& all);
  bool leave_out(Adjustment& adjustment, const Surprises& all);

  std::vector<int> returns_of_views_;
  std::vector<int> returns_of_surveys_;
};

// Changes the sigmas' scales; the largest relative change.
double estimate_noise(Adjustment& adjustment, const Information& information,
                      const NoiseOptions& options);

// solve, inform, estimate and edit by turns. Nothing where the numbers are not determined.
std::optional<Information> adjust_and_edit(Adjustment& adjustment, bool estimate);

}  // namespace dottrack::calibrate
