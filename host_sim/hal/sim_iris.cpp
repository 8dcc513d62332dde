#include "host_sim/hal/sim_iris.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dottrack::host_sim {

SimIris::SimIris(std::size_t cameras, const IrisModel& model, const rtos::Clock& clock)
    : cameras_(cameras), model_(model), clock_(clock) {
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

double SimIris::opening(std::size_t camera, Time at) const {
  const Blades& blades = blades_[camera];
  if (blades.automatic) {
    const double drift = model_.drift_per_s * to_seconds(at - blades.since);
    return within_range(blades.opening * (1.0 + drift));
  }
  const double motor = motor_at(blades, at);
  const double play = 0.5 * model_.backlash;
  return within_range(std::clamp(blades.opening, motor - play, motor + play));
}

bool SimIris::do_move_to(std::size_t camera, double opening_wanted) {
  if (camera >= cameras_ || !std::isfinite(opening_wanted)) return false;
  Blades& blades = blades_[camera];
  const Time now = clock_.now();
  const double opening_now = opening(camera, now);
  const double motor = blades.automatic ? opening_now : motor_at(blades, now);
  blades = {now, opening_now, motor, within_range(opening_wanted), false};
  return true;
}

bool SimIris::do_release_to_auto(std::size_t camera) {
  if (camera >= cameras_) return false;
  const Time now = clock_.now();
  const double opening_now = opening(camera, now);
  blades_[camera] = {now, opening_now, opening_now, opening_now, true};
  return true;
}

hal::IrisState SimIris::do_state(std::size_t camera) const {
  if (camera >= cameras_) return {.healthy = false};
  const Blades& blades = blades_[camera];
  const Time now = clock_.now();
  hal::IrisState state;
  state.opening = opening(camera, now);
  state.automatic = blades.automatic;
  state.moving = !blades.automatic && motor_at(blades, now) != blades.target;
  return state;
}

}  // namespace dottrack::host_sim
