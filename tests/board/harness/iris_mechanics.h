#pragma once
// What a P-iris does with the levels of its lines: a motor, its play, and blades between two stops.

#include <cstdint>

namespace dottrack::board {

struct IrisShape {
  int travel_steps = 40;
  int backlash_steps = 2;
};

class IrisMechanics {
 public:
  // Starts half open, its play half taken up: nobody knows where a lens was left.
  explicit IrisMechanics(const IrisShape& shape)
      : shape_(shape), blades_(shape.travel_steps / 2), play_(shape.backlash_steps / 2) {}

  enum class Line : std::uint8_t { step, direction, enable, override_auto };
  void set(Line line, bool high);

  int blades_steps() const { return blades_; }  // 0 closed to travel_steps fully open
  double opening() const { return static_cast<double>(blades_) / shape_.travel_steps; }
  std::uint64_t steps() const { return steps_; }            // rising edges of the step line
  std::uint64_t idle_steps() const { return idle_steps_; }  // of these, with the motor switched off
  bool was_closed() const { return was_closed_; }           // has met its closed end
  bool overridden() const { return override_auto_; }
  bool enabled() const { return enable_; }

 private:
  void step();

  IrisShape shape_;
  int blades_;
  int play_;  // of the motor against the blades: 0 pushes closing, backlash_steps pushes opening
  bool step_ = false;
  bool opens_ = false;
  bool enable_ = false;
  bool override_auto_ = false;
  bool was_closed_ = false;
  std::uint64_t steps_ = 0;
  std::uint64_t idle_steps_ = 0;
};

}  // namespace dottrack::board
