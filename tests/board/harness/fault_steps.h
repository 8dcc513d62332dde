#pragma once
// What the faults have in common: things to wait for, and a way to end early. Not for others.

#include <string>
#include <string_view>

#include "tests/board/harness/findings.h"

namespace dottrack::board {

inline constexpr auto kCommandPatience = std::chrono::seconds(60);
inline constexpr auto kPosePatience = std::chrono::seconds(90);
inline constexpr std::size_t kPosesToGoOn = 10;

// Whether it stands there by itself: cam1 is not in "cam11".
bool holds_word(std::string_view text, std::string_view word);

// A line of the journal, from line `first` on, that holds all of these words.
Result<std::string> await_journal(const Board& board, std::size_t first,
                                  std::initializer_list<std::string_view> words, Duration patience);

// The unit's own status (systemctl status) comes to hold a word, or comes to hold it no more.
Result<std::string> await_status(Board& board, std::string_view word, bool holds,
                                 Duration patience);

// The service is the process that it was.
Result<void> still_process(Board& board, const std::string& main_process);

// Ends a finding: what was found, or the error that ended it.
Finding conclude(std::string what, const Result<std::string>& figures);

// The poses from message `first` on are right; adds what they are to the figures.
Result<std::string> with_right_poses(Board& board, std::size_t first, std::string figures);

}  // namespace dottrack::board
