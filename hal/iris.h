#pragma once
// What the application asks of the lens irises.

#include <cstddef>
#include <cstdint>

namespace dottrack::hal {

struct IrisState {
  double opening = 1.0;  // 0 closed to 1 fully open
  bool moving = false;
  bool automatic = true;  // the lens's own auto-iris is in charge
  bool healthy = true;    // answers and is where it was sent
};

// The irises of all cameras. Non-blocking: a request starts a movement, state() tells how it goes.
class Iris {
 public:
  Iris() = default;
  Iris(const Iris&) = delete;
  Iris& operator=(const Iris&) = delete;
  virtual ~Iris() = default;

  // Overrides the auto-iris and moves towards an opening in [0, 1]; false when there is no such
  // iris.
  bool move_to(std::size_t camera, double opening) { return do_move_to(camera, opening); }
  // Gives the lens back to its own auto-iris.
  bool release_to_auto(std::size_t camera) { return do_release_to_auto(camera); }
  IrisState state(std::size_t camera) const { return do_state(camera); }

 private:
  virtual bool do_move_to(std::size_t camera, double opening) = 0;
  virtual bool do_release_to_auto(std::size_t camera) = 0;
  virtual IrisState do_state(std::size_t camera) const = 0;
};

}  // namespace dottrack::hal
