#pragma once
// Ctrl-C as a wish that a long run can ask for, so that it ends cleanly with what it has.

namespace dottrack::workstation {

// While one of these lives, the first SIGINT or SIGTERM is only noted; the second one ends the
// program as usual. At most one at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool wanted();
};

}  // namespace dottrack::workstation
