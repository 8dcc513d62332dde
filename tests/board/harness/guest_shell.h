#pragma once
// Commands for a root shell of the guest, on a serial line.

#include <functional>
#include <string>

#include "hal/base/result.h"
#include "tests/board/harness/line_log.h"

namespace dottrack::board {

struct CommandOutput {
  int status = 0;
  std::string text;  // standard output and standard error, without the last end of line
};

class GuestShell {
 public:
  explicit GuestShell(LineLog& line) : line_(line) {}

  // After power-on or a reset: waits until the shell answers. `heard_before`: how many bytes had
  // come from the line when the board started; nothing is sent before more come.
  Result<void> wait_until_ready(std::size_t heard_before, Duration patience);

  // One line of shell, up to 3000 characters. An error is a shell that does not answer in time; how
  // the command ended is its status.
  Result<CommandOutput> run(const std::string& command, Duration patience);

  // As run, but a status other than 0 is an error too.
  Result<std::string> check(const std::string& command, Duration patience);

 private:
  bool answers(int attempt);

  LineLog& line_;
  unsigned commands_ = 0;
};

}  // namespace dottrack::board
