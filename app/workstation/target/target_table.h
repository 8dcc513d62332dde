#pragma once
// How good a target is, as a short table for a person.

#include <span>
#include <string>

#include "app/config/target_judgement.h"
#include "app/core/rig.h"

namespace dottrack::workstation {

// Judged completely, well conditioned, and not ambiguous.
bool good(const config::TargetJudgement& judgement);

// Several lines; `judgement` is of the target, with a reach of kAmple. What to move is found here.
std::string target_table(const core::Target& target, const config::TargetJudgement& judgement,
                         std::span<const std::string> names);

}  // namespace dottrack::workstation
