#include "app/firmware/losses.h"

#include <fmt/format.h>

#include <initializer_list>
#include <string_view>

namespace dottrack::firmware {
namespace {

struct Loss {
  std::uint64_t count;
  std::string_view what;
};

std::optional<std::string> list(const std::string& subject, std::initializer_list<Loss> all) {
  std::string text;
  for (const Loss& loss : all) {
    if (loss.count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", loss.count, loss.what);
  }
  if (text.empty()) return std::nullopt;
  return fmt::format("{}: {}", subject, text);
}

}  // namespace

std::optional<std::string> losses(const std::string& camera, const drivers::CameraHealth& before,
                                  const drivers::CameraHealth& now) {
  return list("camera " + camera, {{now.gaps - before.gaps, "frames lost"},
                                   {now.late - before.late, "late"},
                                   {now.errors - before.errors, "damaged"}});
}

std::optional<std::string> losses(const drivers::SocketCanCounts& before,
                                  const drivers::SocketCanCounts& now) {
  return list("CAN", {{now.error_frames - before.error_frames, "error frames"},
                      {now.bus_offs - before.bus_offs, "times bus-off"},
                      {now.refused_full - before.refused_full, "frames without room"}});
}

}  // namespace dottrack::firmware
