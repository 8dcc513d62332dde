#pragma once
// A connected socket of this machine, as the emulator offers them.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "hal/base/result.h"
#include "hal/base/time.h"

namespace dottrack::board {

class UnixSocket {
 public:
  // Tries until the deadline: the emulator takes a moment to offer the socket.
  static Result<UnixSocket> connect(const std::filesystem::path& path, Duration patience);
  UnixSocket(UnixSocket&& other) noexcept;
  UnixSocket& operator=(UnixSocket&& other) noexcept;
  ~UnixSocket();

  // False when the other side is gone.
  bool send(std::string_view bytes);

  enum class Read : std::uint8_t { bytes, nothing, closed };
  // Waits up to `patience` for bytes; `size` says how many came.
  Read receive(std::span<char> buffer, Duration patience, std::size_t& size);

 private:
  explicit UnixSocket(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace dottrack::board
