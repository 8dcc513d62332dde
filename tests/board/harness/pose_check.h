#pragma once
// The poses of a stretch of a run against the simulator's truth.

#include <string>

#include "tests/board/harness/board.h"
#include "tests/board/harness/truth_check.h"

namespace dottrack::board {

struct PoseCheck {
  TruthCheck truth;
  std::size_t unmatched = 0;    // poses of an instant at which no camera exposed
  std::vector<double> late_ms;  // stamps against the middle of their exposure, ascending

  bool holds() const { return truth.wrong() == 0 && unmatched == 0; }
  // `12 poses off by up to 8 mm and 0.31 deg`
  std::string figures() const;
};

// Of the messages from `first` on.
PoseCheck check_poses(Board& board, std::size_t first);

// Waits for `count` poses more, from message `first` on. The index after the last of them.
Result<std::size_t> await_poses(Board& board, std::size_t first, std::size_t count,
                                Duration patience);

}  // namespace dottrack::board
