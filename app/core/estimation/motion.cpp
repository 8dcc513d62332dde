#include "app/core/estimation/motion.h"

#include "app/core/estimation/rotation.h"

namespace dottrack::estimation {
core::Motion motion_between(const core::Pose& before, Time captured_before, const core::Pose& now,
                            Time captured_now) {
  core::Motion motion;
  const double seconds = to_seconds(captured_now - captured_before);
  if (!(seconds > 0.0)) return motion;
  motion.known = true;
  motion.velocity_m_s = (now.position_m - before.position_m) / seconds;
  motion.rates_rad_s = rotation_vector(before.orientation.conjugate() * now.orientation) / seconds;
  return motion;
}

}  // namespace dottrack::estimation
