#include "tests/board/harness/fault_steps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <thread>
#include <utility>

#include "tests/board/harness/host_clock.h"

namespace dottrack::board {

bool holds_word(std::string_view text, std::string_view word) {
  const auto is_part = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_part(text[at - 1])) && (end == text.size() || !is_part(text[end])))
      return true;
  }
  return false;
}

Result<std::string> await_journal(const Board& board, std::size_t first,
                                  std::initializer_list<std::string_view> words,
                                  Duration patience) {
  const auto holds_all = [&](std::string_view line) {
    return std::all_of(words.begin(), words.end(),
                       [&](std::string_view word) { return holds_word(line, word); });
  };
  const auto found = board.journal().wait_for(holds_all, first, patience);
  if (found) return board.journal().text(*found);
  return fail(fmt::format("no line with \"{}\" in the journal within {:.0f} s",
                          fmt::join(words, "\" and \""), to_seconds(patience)));
}

Result<std::string> await_status(Board& board, std::string_view word, bool holds,
                                 Duration patience) {
  const Time deadline = host_now() + patience;
  Result<std::string> status = std::string();
  do {
    status = board.service("StatusText");
    if (!status) return status;
    if (holds_word(*status, word) == holds) return status;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  } while (host_now() < deadline);
  return fail(fmt::format("the status still {} \"{}\" after {:.0f} s: {}",
                          holds ? "lacks" : "holds", word, to_seconds(patience), *status));
}

Result<void> still_process(Board& board, const std::string& main_process) {
  const auto now = board.service("MainPID");
  if (!now) return tl::unexpected(now.error());
  if (*now == main_process) return {};
  const auto why = board.shell().check(
      fmt::format("journalctl -b -o cat -n 3 -u {} -g 'FATAL|Main process exited|timeout'",
                  kService),
      kCommandPatience);
  return fail(fmt::format("the service was started anew: process {} is now {}; {}", main_process,
                          *now, why ? *why : why.error().message));
}

Finding conclude(std::string what, const Result<std::string>& figures) {
  return {std::move(what), figures.has_value(), figures ? *figures : figures.error().message};
}

Result<std::string> with_right_poses(Board& board, std::size_t first, std::string figures) {
  const PoseCheck check = check_poses(board, first);
  figures += "; " + check.figures();
  if (!check.holds()) return fail(std::move(figures));
  return figures;
}

}  // namespace dottrack::board
