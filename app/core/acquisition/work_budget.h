#pragma once
// The bound of acquisition's work in one tick, counted in deterministic units (about ten
// nanoseconds each on a desktop core), never in time: the same frames stop at the same place.

#include <cstdint>

namespace dottrack::acquisition {

class WorkBudget {
 public:
  explicit WorkBudget(std::uint64_t units) : limit_(units) {}

  // Takes the units; false once more has been spent than there was.
  bool spend(std::uint64_t units) {
    spent_ += units;
    return spent_ <= limit_;
  }
  bool exhausted() const { return spent_ > limit_; }
  // Whether a step of so many units, which is never left in its middle, should begin now: it does
  // not overdraw the budget, or there will never be more left than now.
  bool fits(std::uint64_t units) const { return spent_ == 0 || spent_ + units <= limit_; }
  std::uint64_t spent() const { return spent_; }

 private:
  std::uint64_t limit_;
  std::uint64_t spent_ = 0;
};

}  // namespace dottrack::acquisition
