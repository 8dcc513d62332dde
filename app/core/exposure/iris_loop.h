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

// What one second's exposure at unit gain gives; 0 where it is unknown.
struct IrisLight {
  double dots = 0.0;    // the brightest dot's level
  double image = 0.0;   // the whole image's mean
  double level = 1.0;   // of the brightest dot now, over what it should be
  bool steady = false;  // as bright as it should be, and no change on its way
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
//
// An iris that nothing asks to move is exercised: opened or closed by 0.06 and back, when it is
// taken over, when the light has changed by half, and every 3600 ticks. The image's mean tells
// whether the light followed; the way out and the way back are judged as a pair, so that light that
// fades meanwhile and play of the blades do not count. Two pairs one after another that show next
// to nothing are those of an iris that is stuck.
class IrisLoop {
 public:
  // Once a tick. `delay_ticks`: until a change shows in the images.
  IrisOrder step(const IrisView& view, IrisWish wish, const IrisLight& light, int delay_ticks);
  // The camera has no iris that takes orders.
  void refused() { present_ = false; }

  bool present() const { return present_; }
  // Does not answer, or moves nothing.
  bool fault() const { return fault_; }
  // It was sent further and did not go, and has not been sent the other way since.
  bool ended() const { return present_ && !fault_ && ended_ != IrisWish::none; }
  bool exercising() const { return exercise_ != Exercise::none; }
  // It was sent further in the direction that is wished for, and did not go.
  bool at_end(IrisWish wish) const {
    return !present_ || fault_ || (wish != IrisWish::none && ended_ == wish);
  }

 private:
  IrisOrder take_over(const IrisView& view);
  IrisOrder give_back();
  IrisOrder begin(const IrisView& view, IrisWish wish, const IrisLight& light);
  IrisOrder move(const IrisView& view, const IrisLight& light, double opening);
  IrisOrder move_on(const IrisView& view);
  IrisOrder settle(const IrisView& view, const IrisLight& light, int delay_ticks);
  void end(const IrisView& view, const IrisLight& light);
  bool judge(double opened, double brightened);
  void count(bool followed) { contradictions_ = followed ? 0 : contradictions_ + 1; }

  bool is_to_exercise(const IrisLight& light) const;
  IrisOrder exercise(const IrisView& view, const IrisLight& light);
  IrisOrder go_back(const IrisView& view, const IrisLight& light);
  void note(const IrisLight& light);
  void end_exercise(const IrisView& view, const IrisLight& light);

  enum class Phase : std::uint8_t { resting, moving, settling };
  enum class Exercise : std::uint8_t { none, out, back };

  bool present_ = true;
  bool fault_ = false;
  Phase phase_ = Phase::resting;
  int phase_ticks_ = 0;
  int retry_ticks_ = 0;  // until an iris that was given back is tried again
  int contradictions_ = 0;
  IrisWish wish_ = IrisWish::none;   // of the movement that is under way
  IrisWish ended_ = IrisWish::none;  // further this way it does not go
  double opening_before_ = 1.0;
  IrisLight light_before_;
  Exercise exercise_ = Exercise::none;
  bool out_is_known_ = false;
  double came_from_ = 1.0;   // where an exercise began
  double opened_out_ = 1.0;  // by the first half of an exercise: ratios
  double brightened_out_ = 1.0;
  double light_exercised_ = 0.0;  // of the image, when the iris was last exercised; 0: it was not
  int idle_ticks_ = 0;            // since then
};

}  // namespace dottrack::exposure
