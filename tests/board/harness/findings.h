#pragma once
// What a run looks at, one after the other. Each finding waits for what it looks for, within
// limits.

#include <vector>

#include "tests/board/harness/board.h"
#include "tests/board/harness/pose_check.h"
#include "tests/board/harness/verdict.h"

namespace dottrack::board {

// What a good run shows: from power-on to `poses` poses.
std::vector<Finding> nominal_findings(Board& board, std::size_t poses);

// Of them, what the messages from `first` on say besides poses.
std::vector<Finding> bus_findings(Board& board, std::size_t first);

// The faults; each leaves the unit tracking.
Finding camera_unplugged(Board& board);
Finding can_bus_down(Board& board);
Finding broken_rig_file(Board& board);
Finding other_exposure(Board& board);
Finding lamps_dimmed(Board& board);
Finding recording_disk_full(Board& board);
Finding process_stopped(Board& board);

// The end: the service is told to stop and leaves everything safe.
Finding told_to_end(Board& board);
// The unit's own measurement, on the emulated board.
Finding measuring(Board& board);
// The drivers' own tests against the guest's kernel; the service is stopped.
Finding hardware_tests(Board& board);

}  // namespace dottrack::board
