#pragma once
// One thread sleeps, any other wakes it.

#include "hal/base/result.h"
#include "hal/base/time.h"

namespace dottrack::drivers {

// A ring that nobody waits for is not lost: the next wait() returns at once. Allocation-free after
// open().
class Doorbell {
 public:
  Doorbell() = default;
  ~Doorbell();
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  Result<void> open();

  void ring();
  // Until it rings, or at most this long; not at all when that is not positive. Takes the rings.
  void wait(Duration at_most);

 private:
  int fd_ = -1;
};

}  // namespace dottrack::drivers
