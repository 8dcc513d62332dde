#pragma once
// What the application asks of a single digital output: the cameras' trigger, the status lamp.

namespace dottrack::hal {

// Contract: nothing here blocks, allocates or throws after construction.
class OutputLine {
 public:
  OutputLine() = default;
  OutputLine(const OutputLine&) = delete;
  OutputLine& operator=(const OutputLine&) = delete;
  virtual ~OutputLine() = default;

  // Active or not, as the wiring defines active; false when the line cannot be driven.
  bool set(bool active) { return do_set(active); }

 private:
  virtual bool do_set(bool active) = 0;
};

}  // namespace dottrack::hal
