#include "app/core/estimation/motion_state.h"

#include "app/core/estimation/rotation.h"

namespace dottrack::estimation {

Vector12d difference(const MotionState& a, const MotionState& b) {
  Vector12d step;
  step << a.position_m - b.position_m, rotation_vector(a.orientation * b.orientation.conjugate()),
      a.velocity_m_s - b.velocity_m_s, a.rates_rad_s - b.rates_rad_s;
  return step;
}

void move_by(const Vector12d& step, MotionState& state) {
  state.position_m += step.segment<3>(0);
  state.orientation = turn_by(step.segment<3>(3)) * state.orientation;
  state.orientation.normalize();
  state.velocity_m_s += step.segment<3>(6);
  state.rates_rad_s += step.segment<3>(9);
}

}  // namespace dottrack::estimation
