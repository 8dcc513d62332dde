#include "tests/board/harness/rig_edits.h"

#include <fmt/format.h>

#include "tests/board/harness/fault_steps.h"

namespace dottrack::board {
namespace {

constexpr const char* kEdit =
    "rig=$(readlink -f /etc/dottrack/rig.toml) && "
    "mount -o remount,rw \"$(findmnt -no TARGET -T \"$rig\")\" && cp \"$rig\" /run/rig.toml && "
    "sed '{}' /run/rig.toml >\"$rig\"";
constexpr const char* kRestore =
    "rig=$(readlink -f /etc/dottrack/rig.toml) && cp /run/rig.toml \"$rig\" && sync && "
    "mount -o remount,ro \"$(findmnt -no TARGET -T \"$rig\")\"";
constexpr const char* kHangUp = "systemctl kill -s HUP --kill-who=main dottrackd.service";

Result<void> read_anew(Board& board, const std::string& prepare) {
  for (const std::string& command : {prepare, std::string(kHangUp)}) {
    if (auto done = board.shell().check(command, kCommandPatience); !done) {
      return tl::unexpected(done.error());
    }
  }
  return {};
}

}  // namespace

Result<void> edit_rig(Board& board, const std::string& script) {
  return read_anew(board, fmt::format(kEdit, script));
}

Result<void> restore_rig(Board& board) {
  return read_anew(board, kRestore);
}

}  // namespace dottrack::board
