#pragma once
// One camera's iris: slow, stepwise, and watched.

#include <cstdint>

namespace dottrack::exposure {

// What the iris says of itself.
struct IrisView {
  double opening = 1.0;  // 0 closed to 1 fully open
  bool moving = false;
  bool automatic = true;  // the lens's own auto-iris is in charge
  bool healthy = true;
};

enum class IrisWish : std::uint8_t { none, open, close };
enum class IrisAct : std::uint8_t { none, move, release };

struct IrisOrder {
  IrisAct act = IrisAct::none;
  double opening = 1.0;  // of a move
};

// Overrides the auto-iris at the opening it has, then moves by a seventh at a time where exposure
// time and gain are at the end of what they can do. A movement ends when the iris says so; then the
// light that the dots gave before and after is compared. Two movements one after another that
// change next to nothing are those of an iris that is stuck: it is given back to its lens, and
// tried again much later.
class IrisLoop {
 public:
  // Once a tick. `light`: the dots' level for one second's exposure at unit gain, 0 when it is
  // unknown. `delay_ticks`: until a change shows in the images.
  IrisOrder step(const IrisView& view, IrisWish wish, double light, int delay_ticks);
  // The camera has no iris that takes orders.
  void refused() { present_ = false; }

  bool present() const { return present_; }
  // Does not answer, or moves nothing.
  bool fault() const { return fault_; }
  // It was sent further in the direction that is wished for, and did not go.
  bool at_end(IrisWish wish) const {
    return !present_ || fault_ || (wish != IrisWish::none && ended_ == wish);
  }

 private:
  IrisOrder take_over(const IrisView& view);
  IrisOrder give_back();
  IrisOrder begin(const IrisView& view, IrisWish wish, double light);
  void end(const IrisView& view, double light);
  bool judge(double opened, double brightened);

  enum class Phase : std::uint8_t { resting, moving, settling };

  bool present_ = true;
  bool fault_ = false;
  Phase phase_ = Phase::resting;
  int phase_ticks_ = 0;
  int retry_ticks_ = 0;  // until an iris that was given back is tried again
  int contradictions_ = 0;
  IrisWish wish_ = IrisWish::none;   // of the movement that is under way
  IrisWish ended_ = IrisWish::none;  // further this way it does not go
  double opening_before_ = 1.0;
  double light_before_ = 0.0;
};

}  // namespace dottrack::exposure
