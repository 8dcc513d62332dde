#pragma once
// A CAN bus that only remembers: a log in the format of `candump -L`.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/can_bus.h"
#include "rtos_shim/clock.h"

namespace dottrack::drivers {

// A line a frame: `(seconds.micros) can0 300#0011223344556677`, stamped with the given clock.
// send() writes into memory; flush() moves that to the file and is not for the loop. Between two
// flushes there is room for some hundred frames; after that, send() answers try_again.
class CandumpCanBus final : public hal::CanBus {
 public:
  static Result<std::unique_ptr<CandumpCanBus>> open(const std::filesystem::path& path,
                                                     const rtos::Clock& clock,
                                                     std::string interface = "can0");

  // An error names the file; afterwards the bus is absent and takes no frame.
  Result<void> flush();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Close>;

  CandumpCanBus(const std::filesystem::path& path, File file, const rtos::Clock& clock,
                std::string interface);

  hal::SendResult do_send(const hal::CanFrame& frame, Time deadline) override;
  bool do_receive(hal::CanFrame&) override { return false; }
  hal::CanState do_state() const override;
  std::size_t write_line(const hal::CanFrame& frame, char* line) const;

  std::filesystem::path path_;
  File file_;
  const rtos::Clock& clock_;
  std::string interface_;
  std::vector<char> pending_;
  std::size_t pending_size_ = 0;
  bool failed_ = false;
};

}  // namespace dottrack::drivers
