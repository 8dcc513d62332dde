#include "app/workstation/trial.h"

namespace dottrack::workstation {
namespace {

bool is_held_back(core::Reason reason) {
  return reason == core::Reason::held_back || reason == core::Reason::ambiguous;
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::right_lock:
      return "right";
    case Outcome::wrong_lock:
      return "wrong";
    case Outcome::held_back:
      return "held_back";
    case Outcome::no_lock:
      return "none";
  }
  return "none";
}

void take(const core::TickResult& result, const std::optional<TruePose>& vehicle, Trial& trial) {
  trial.reason = result.reason;
  trial.dots_matched = result.acquisition.dots_matched;
  trial.min_views = result.acquisition.min_views;
  if (result.has_candidate && !trial.candidate) {
    trial.candidate = {result.acquisition.false_lock_probability,
                       vehicle && !error_of(result.candidate, *vehicle).wrong_lock()};
  }
  if (!result.has_pose) {
    if (is_held_back(result.reason)) trial.outcome = Outcome::held_back;
    return;
  }
  trial.lock_tick = static_cast<int>(result.tick);
  trial.lock_probability = result.false_lock_probability;
  trial.outcome = Outcome::wrong_lock;
  if (!vehicle) return;
  const PoseError off = error_of(result.pose, *vehicle);
  trial.position_mm = off.position_mm();
  trial.attitude_deg = off.attitude_deg();
  if (!off.wrong_lock()) trial.outcome = Outcome::right_lock;
}

}  // namespace dottrack::workstation
