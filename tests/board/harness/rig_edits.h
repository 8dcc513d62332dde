#pragma once
// Changing the unit's rig.toml while it runs.

#include <string>

#include "tests/board/harness/board.h"

namespace dottrack::board {

// As a user would who has the card in hand, but with the unit running: edits the file by a `sed`
// script without quotes, and has it read anew.
Result<void> edit_rig(Board& board, const std::string& script);
// The file as it was before the last edit_rig(), read anew.
Result<void> restore_rig(Board& board);

}  // namespace dottrack::board
