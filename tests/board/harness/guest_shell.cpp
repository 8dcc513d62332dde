#include "tests/board/harness/guest_shell.h"

#include <fmt/format.h>

#include <cstdlib>
#include <thread>

#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Without echo and prompt, only what commands print comes back.
constexpr std::string_view kPlainShell = "stty -echo; PS1= PS2= exec sh\n";

}  // namespace

bool GuestShell::answers(int attempt) {
  const std::string answer = fmt::format("shell-{}-ready", attempt);
  const std::size_t first = line_.size();
  // Split, so that the echo of the command is not taken for its answer.
  line_.send(kPlainShell);
  line_.send(fmt::format("echo shell-{}-''ready\n", attempt));
  const auto is_answer = [&](std::string_view text) { return text.ends_with(answer); };
  return line_.wait_for(is_answer, first, seconds(4)).has_value();
}

Result<void> GuestShell::wait_until_ready(std::size_t heard_before, Duration patience) {
  const Time deadline = host_now() + patience;
  while (line_.bytes() == heard_before && host_now() < deadline && !line_.closed()) {
    std::this_thread::sleep_for(milliseconds(50));
  }
  for (int attempt = 1; host_now() < deadline && !line_.closed(); ++attempt) {
    if (answers(attempt)) return {};
  }
  if (line_.closed()) return fail("the emulator has ended; see emulator.log");
  return fail(fmt::format("the guest's shell did not answer within {:.0f} s; see the console's log",
                          to_seconds(patience)));
}

Result<CommandOutput> GuestShell::run(const std::string& command, Duration patience) {
  const std::string end = fmt::format("command-{}-ended-with ", ++commands_);
  const std::size_t first = line_.size();
  line_.send(
      fmt::format("{{ {} ; }} </dev/null 2>&1; status=$?; echo; echo {}$status\n", command, end));
  const auto is_end = [&](std::string_view text) { return text.starts_with(end); };
  const auto last = line_.wait_for(is_end, first, patience);
  if (!last) {
    return fail(fmt::format("no answer from the guest within {:.0f} s to: {}", to_seconds(patience),
                            command));
  }
  CommandOutput output;
  output.status = std::atoi(line_.text(*last).c_str() + end.size());
  for (std::size_t i = first; i < *last; ++i) output.text += line_.text(i) + "\n";
  while (output.text.ends_with('\n')) output.text.pop_back();
  return output;
}

Result<std::string> GuestShell::check(const std::string& command, Duration patience) {
  auto output = run(command, patience);
  if (!output) return tl::unexpected(output.error());
  if (output->status != 0) {
    return fail(
        fmt::format("in the guest: {}: status {}: {}", command, output->status, output->text));
  }
  return std::move(output->text);
}

}  // namespace dottrack::board
