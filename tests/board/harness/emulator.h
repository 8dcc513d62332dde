#pragma once
// The emulated computer: QEMU's command line and its control connection.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/board/harness/child_process.h"
#include "tests/board/harness/line_log.h"

namespace dottrack::board {

struct EmulatorSetup {
  std::filesystem::path image;      // the disk that the board boots from; it is not changed
  std::filesystem::path observer;   // a second disk with what only the test needs
  std::filesystem::path firmware;   // UEFI's code, and
  std::filesystem::path variables;  // what it remembers; a copy of one's own
  std::filesystem::path sockets;    // folder of the sockets; a short name
  std::filesystem::path out;        // folder of the logs
  std::size_t cameras = 12;
  unsigned processors = 2;
  unsigned memory_mb = 2048;
};

// Names of the sockets in EmulatorSetup::sockets.
inline constexpr const char* kShellSocket = "shell";
inline constexpr const char* kControlSocket = "control";
inline constexpr const char* kCanSocket = "can";
inline constexpr const char* kGpioSocket = "gpio";
inline constexpr const char* kJournalSocket = "journal";
std::string camera_socket(std::size_t camera);

std::vector<std::string> emulator_command(const EmulatorSetup& setup);

class Emulator {
 public:
  // Power on. The cameras' sockets must be there.
  static Result<std::unique_ptr<Emulator>> start(const EmulatorSetup& setup);

  // How often the board was reset since power-on, and by its watchdog.
  std::size_t resets() const;
  std::size_t watchdog_bites() const;
  // Waits for the first reset after `resets_before`.
  bool wait_for_reset(std::size_t resets_before, Duration patience) const;

 private:
  Emulator(std::unique_ptr<ChildProcess> process, UnixSocket control,
           const std::filesystem::path& log);

  std::unique_ptr<ChildProcess> process_;
  LineLog control_;
};

}  // namespace dottrack::board
