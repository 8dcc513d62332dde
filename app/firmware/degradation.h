#pragma once
// What the unit asked the machine for and did not get.

#include <string>
#include <utility>
#include <vector>

#include "hal/base/result.h"

namespace dottrack::firmware {

// Without permission to do with less, every lack is an error at start. With it, each is noted, and
// the unit's status names them as long as it runs.
class Degradation {
 public:
  explicit Degradation(bool allowed) : allowed_(allowed) {}

  // True: go on without.
  bool accepts(const Error& lack) {
    if (allowed_) lacks_.push_back(lack.message);
    return allowed_;
  }

  const std::vector<std::string>& lacks() const { return lacks_; }

 private:
  bool allowed_;
  std::vector<std::string> lacks_;
};

}  // namespace dottrack::firmware
