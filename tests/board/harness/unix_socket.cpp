#include "tests/board/harness/unix_socket.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

int try_connect(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return -1;
  if (::connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return descriptor;
  }
  ::close(descriptor);
  return -1;
}

}  // namespace

Result<UnixSocket> UnixSocket::connect(const std::filesystem::path& path, Duration patience) {
  const std::string name = path.string();
  if (name.size() >= sizeof(sockaddr_un::sun_path)) {
    return fail(fmt::format("{}: the name of the socket is too long", name));
  }
  const Time deadline = host_now() + patience;
  do {
    if (const int descriptor = try_connect(name); descriptor >= 0) return UnixSocket(descriptor);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  } while (host_now() < deadline);
  return fail(
      fmt::format("{}: nobody offers this socket within {:.0f} s", name, to_seconds(patience)));
}

UnixSocket::UnixSocket(UnixSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

UnixSocket& UnixSocket::operator=(UnixSocket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

UnixSocket::~UnixSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool UnixSocket::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

UnixSocket::Read UnixSocket::receive(std::span<char> buffer, Duration patience, std::size_t& size) {
  size = 0;
  pollfd waiting{descriptor_, POLLIN, 0};
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(patience).count();
  if (::poll(&waiting, 1, static_cast<int>(ms)) <= 0) return Read::nothing;
  const ssize_t got = ::recv(descriptor_, buffer.data(), buffer.size(), 0);
  if (got < 0 && errno == EINTR) return Read::nothing;
  if (got <= 0) return Read::closed;
  size = static_cast<std::size_t>(got);
  return Read::bytes;
}

}  // namespace dottrack::board
