#pragma once
// A program that runs beside the harness and never longer than it.

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/base/time.h"

namespace dottrack::board {

class ChildProcess {
 public:
  // command[0] is looked for in PATH; its output goes to a file.
  static Result<std::unique_ptr<ChildProcess>> start(const std::vector<std::string>& command,
                                                     const std::filesystem::path& output);
  // Asks it to end, and makes it end after a while.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool running();

 private:
  explicit ChildProcess(pid_t id) : id_(id) {}
  pid_t id_;
};

}  // namespace dottrack::board
