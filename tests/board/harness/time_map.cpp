#include "tests/board/harness/time_map.h"

#include <algorithm>

namespace dottrack::board {

void TimeMap::add(Time asked, Time guest, Time answered) {
  const Duration earliest = asked - guest;
  const Duration latest = answered - guest;
  earliest_ = known_ ? std::max(earliest_, earliest) : earliest;
  latest_ = known_ ? std::min(latest_, latest) : latest;
  known_ = true;
}

}  // namespace dottrack::board
