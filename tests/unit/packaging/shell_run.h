#pragma once
// A shell command and what it said.

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace dottrack::test {

struct ShellRun {
  int status = -1;
  std::string said;  // standard output and standard error
};

inline ShellRun run_shell(const std::string& command) {
  std::FILE* pipe = ::popen((command + " 2>&1 </dev/null").c_str(), "re");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  ShellRun run;
  std::array<char, 4096> block{};
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), pipe)) {
    run.said.append(block.data(), size);
  }
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) run.status = WEXITSTATUS(status);
  return run;
}

}  // namespace dottrack::test
