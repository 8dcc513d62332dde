#include "host_sim/hal/sim_iris.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

namespace dottrack::host_sim {

SimIris::SimIris(std::size_t cameras, const IrisModel& model, const rtos::Clock& clock,
                 std::vector<IrisFault> faults)
    : cameras_(cameras), model_(model), clock_(clock), faults_(std::move(faults)) {
  assert(cameras <= kMaxCameras);
  const double start = within_range(model.opening);
  blades_.fill({clock.now(), start, start, start, true});
}

double SimIris::within_range(double opening) const {
  return std::clamp(opening, model_.min_opening, 1.0);
}

double SimIris::motor_at(const Blades& blades, Time at) const {
  const double reach = model_.speed_per_s * to_seconds(at - blades.since);
  return blades.motor + std::clamp(blades.target - blades.motor, -reach, reach);
}

const IrisFault* SimIris::fault(std::size_t camera, Time at) const {
  const double at_s = to_seconds(at.time_since_epoch());
  for (const IrisFault& fault : faults_) {
    if (fault.camera == camera && fault.from_s <= at_s) return &fault;
  }
  return nullptr;
}

double SimIris::opening(std::size_t camera, Time at) const {
  const IrisFault* stuck = fault(camera, at);
  const Time from = stuck == nullptr ? at : Time{} + Duration(std::llround(1e9 * stuck->from_s));
  const Blades& blades = blades_[camera];
  const double blades_at = from < blades.since ? held_[camera] : commanded(blades, from);
  const double worn = 1.0 + model_.wear_per_s * to_seconds(at.time_since_epoch());
  return within_range(blades_at * worn);
}

// Where the blades are if nothing holds them.
double SimIris::commanded(const Blades& blades, Time at) const {
  if (blades.automatic) {
    const double drift = model_.drift_per_s * to_seconds(at - blades.since);
    return within_range(blades.opening * (1.0 + drift));
  }
  const double motor = motor_at(blades, at);
  const double play = 0.5 * model_.backlash;
  return within_range(std::clamp(blades.opening, motor - play, motor + play));
}

// Before a request moves what a fault already holds.
void SimIris::hold(std::size_t camera, Time now) {
  const IrisFault* stuck = fault(camera, now);
  if (stuck == nullptr) return;
  const Time from = Time{} + Duration(std::llround(1e9 * stuck->from_s));
  if (from >= blades_[camera].since) held_[camera] = commanded(blades_[camera], from);
}

bool SimIris::do_move_to(std::size_t camera, double opening_wanted) {
  if (camera >= cameras_ || !std::isfinite(opening_wanted)) return false;
  Blades& blades = blades_[camera];
  const Time now = clock_.now();
  const double opening_now = commanded(blades, now);
  hold(camera, now);
  const double motor = blades.automatic ? opening_now : motor_at(blades, now);
  blades = {now, opening_now, motor, within_range(opening_wanted), false};
  return true;
}

bool SimIris::do_release_to_auto(std::size_t camera) {
  if (camera >= cameras_) return false;
  const Time now = clock_.now();
  const double opening_now = commanded(blades_[camera], now);
  hold(camera, now);
  blades_[camera] = {now, opening_now, opening_now, opening_now, true};
  return true;
}

hal::IrisState SimIris::do_state(std::size_t camera) const {
  if (camera >= cameras_) return {.healthy = false};
  const Blades& blades = blades_[camera];
  const Time now = clock_.now();
  hal::IrisState state;
  const IrisFault* broken = fault(camera, now);
  state.healthy = broken == nullptr || broken->kind == IrisFaultKind::stuck;
  state.opening = commanded(blades, now);
  state.automatic = blades.automatic;
  state.moving = !blades.automatic && motor_at(blades, now) != blades.target;
  return state;
}

}  // namespace dottrack::host_sim
