#include "host_sim/usb_cameras/camera_port.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "rtos_shim/posix_rt/system_error.h"

namespace dottrack::host_sim {
namespace {

Result<rtos::FileDescriptor> listen_at(const std::filesystem::path& path) {
  const std::string text = path.string();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (text.size() >= sizeof address.sun_path) {
    return fail(fmt::format("{}: a socket's path has at most {} characters", text,
                            sizeof address.sun_path - 1));
  }
  std::copy(text.begin(), text.end(), static_cast<char*>(address.sun_path));
  rtos::FileDescriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  std::error_code ignored;
  if (std::filesystem::is_socket(path, ignored)) std::filesystem::remove(path, ignored);
  const auto* named = reinterpret_cast<const sockaddr*>(&address);  // NOLINT: the call's own idiom
  const bool listening = listener.is_open() && ::bind(listener.get(), named, sizeof address) == 0 &&
                         ::listen(listener.get(), 1) == 0;
  if (!listening) {
    return fail(fmt::format("{}: cannot listen on this socket: {}", text, rtos::reason_of(errno)));
  }
  return listener;
}

}  // namespace

Result<std::unique_ptr<CameraPort>> CameraPort::open(const std::filesystem::path& path,
                                                     const UvcFacts& facts,
                                                     const hal::ExposureSettings& exposure) {
  auto listener = listen_at(path);
  if (!listener) return tl::unexpected<Error>(listener.error());
  return std::unique_ptr<CameraPort>(new CameraPort(path, std::move(*listener), facts, exposure));
}

CameraPort::CameraPort(const std::filesystem::path& path, rtos::FileDescriptor listener,
                       const UvcFacts& facts, const hal::ExposureSettings& exposure)
    : path_(path), listener_(std::move(listener)), device_(facts, exposure) {}

CameraPort::~CameraPort() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

pollfd CameraPort::interest() const {
  if (!link_) return {listener_.get(), POLLIN, 0};
  const int events = POLLIN | (link_->has_unsent() ? POLLOUT : 0);
  return {link_->socket(), static_cast<short>(events), 0};
}

void CameraPort::serve(short events) {
  if (events == 0) return;
  if (!link_) {
    accept();
  } else if ((events & (POLLIN | POLLHUP | POLLERR)) != 0 && !link_->receive()) {
    hang_up();
  }
  settle();
}

void CameraPort::accept() {
  rtos::FileDescriptor socket(
      ::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (socket.is_open()) link_ = std::make_unique<RedirLink>(std::move(socket), device_, plugged_);
}

// The other side is gone, and with it the power.
void CameraPort::hang_up() {
  link_.reset();
  device_.power_up();
}

// After whatever may have changed the link.
void CameraPort::settle() {
  if (link_ && !link_->flush()) hang_up();
  if (!streaming()) frame_.abandon();
}

void CameraPort::plug_in() {
  plugged_ = true;
  if (link_) link_->plug_in();
  settle();
}

void CameraPort::unplug() {
  plugged_ = false;
  if (link_) link_->unplug();
  settle();
}

void CameraPort::show(std::shared_ptr<const GreyImage> picture) {
  if (frame_.in_transit()) {
    ++frames_skipped_;
  } else {
    frame_.begin(std::move(picture));
  }
}

bool CameraPort::send_piece() {
  if (!link_ || !frame_.in_transit()) return false;
  const std::size_t room = link_->room();
  if (room == 0) return false;
  link_->answer(frame_.next_piece(room));
  if (!frame_.in_transit()) ++frames_sent_;
  settle();
  return true;
}

}  // namespace dottrack::host_sim
