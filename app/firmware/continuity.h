#pragma once
// What a vehicle must not notice of a restart: the count of locks goes on.

#include <cstdint>
#include <filesystem>
#include <optional>

#include "hal/base/result.h"

namespace dottrack::firmware {

// Handed from one loop to the next.
struct Continuity {
  std::uint32_t resets = 0;   // locks so far
  std::uint8_t sequence = 0;  // of the next group on CAN
};

// Keeps the count of locks over restarts of the program, in the folder that the service manager
// gives it for that ($STATE_DIRECTORY); without such a folder nothing is kept.
class ContinuityFile {
 public:
  explicit ContinuityFile(std::optional<std::filesystem::path> folder);
  static ContinuityFile of_service();

  // A start counts as a lock of its own, so that the last one before an unclean end cannot be
  // mistaken for the first one after it. Without a file: zero. An error names a file that is not
  // ours.
  Result<std::uint32_t> resets_at_start() const;
  // Replaces the file in one step, if the number is another than the one written last.
  Result<void> keep(std::uint32_t resets);

 private:
  std::optional<std::filesystem::path> file_;
  std::optional<std::uint32_t> kept_;
};

}  // namespace dottrack::firmware
