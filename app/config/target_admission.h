#pragma once
// Whether a rig's target is good enough for its cameras, in words.

#include <span>
#include <string>
#include <vector>

#include "app/config/target_file.h"
#include "app/config/target_judgement.h"
#include "app/core/rig.h"
#include "hal/base/result.h"

namespace dottrack::config {

// What the cameras of a rig know a dot's place by, in each coordinate: a tenth of a pixel at the
// farthest distance of the middling one of them, half as much again for the angles at which they
// see it; half a millimetre at least. Metres.
double expected_sigma_m(const core::Rig& rig);

struct AdmissionRules {
  double sigma_m = 0.0;
  bool allow_ambiguous = false;
};

// Warnings, a line each; an error for an ambiguous target where none is allowed. `path` stands for
// the file in both.
Result<std::vector<std::string>> admit_target(const core::Target& target, const TargetFile& file,
                                              const std::string& path, const AdmissionRules& rules);

// dots "0" "1" "2" taken for "1" "2" "0", turned by 120 degrees
std::string describe(const Relabelling& relabelling, std::span<const std::string> names);

// move dot "2" by 14.2 mm to 0.3132,0.2100,0.6000; empty without moves
std::string describe(std::span<const DotMove> moves, std::span<const std::string> names);

}  // namespace dottrack::config
