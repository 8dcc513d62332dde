#include "tests/board/harness/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

constexpr auto kTimeToEnd = std::chrono::seconds(3);
constexpr int kCannotRun = 127;

// In the child, between fork and exec: only what is safe there.
[[noreturn]] void run(const std::vector<char*>& arguments, int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int none = ::open("/dev/null", O_RDONLY);
  ::dup2(none, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execvp(arguments.front(), arguments.data());
  ::_exit(kCannotRun);
}

}  // namespace

Result<std::unique_ptr<ChildProcess>> ChildProcess::start(const std::vector<std::string>& command,
                                                          const std::filesystem::path& output) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return fail(fmt::format("{}: cannot write the file", output.string()));
  const pid_t id = ::fork();
  if (id == 0) run(arguments, file);
  ::close(file);
  if (id < 0) return fail(fmt::format("{}: cannot start: {}", command[0], std::strerror(errno)));
  return std::unique_ptr<ChildProcess>(new ChildProcess(id));
}

bool ChildProcess::running() {
  if (id_ > 0 && ::waitpid(id_, nullptr, WNOHANG) != 0) id_ = -1;
  return id_ > 0;
}

ChildProcess::~ChildProcess() {
  if (!running()) return;
  ::kill(id_, SIGTERM);
  const Time deadline = host_now() + kTimeToEnd;
  while (running() && host_now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (!running()) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

}  // namespace dottrack::board
