#pragma once
// Lenses that nobody can set any more: the images are taken.

#include "hal/iris.h"

namespace dottrack::drivers {

// Every iris stays with its lens's own control; no request is taken.
class NoIris final : public hal::Iris {
 private:
  bool do_move_to(std::size_t, double) override { return false; }
  bool do_release_to_auto(std::size_t) override { return false; }
  hal::IrisState do_state(std::size_t) const override { return {}; }
};

}  // namespace dottrack::drivers
