#include "tests/unit/host_sim/redir_guest.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>

namespace dottrack::test {
namespace {

constexpr std::chrono::seconds kPatience{60};  // of a busy machine under a sanitizer
constexpr std::uint8_t kStream = 0x81;
constexpr std::size_t kLargestPayloadAt = 22;  // in the stream's parameters

rtos::FileDescriptor connect_to(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  std::copy(text.begin(), text.end(), static_cast<char*>(address.sun_path));
  rtos::FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const auto* named = reinterpret_cast<const sockaddr*>(&address);  // NOLINT: the call's own idiom
  if (::connect(socket.get(), named, sizeof address) != 0) {
    throw std::runtime_error("cannot connect to " + text);
  }
  return socket;
}

}  // namespace

RedirGuest::RedirGuest(const std::filesystem::path& socket)
    : socket_(connect_to(socket)), parser_(usbredirparser_create()) {
  listen_to_parser();
  std::array<std::uint32_t, USB_REDIR_CAPS_SIZE> capabilities{};
  for (const int capability : {usb_redir_cap_connect_device_version, usb_redir_cap_filter,
                               usb_redir_cap_64bits_ids, usb_redir_cap_ep_info_max_packet_size,
                               usb_redir_cap_32bits_bulk_length, usb_redir_cap_bulk_receiving}) {
    usbredirparser_caps_set_cap(capabilities.data(), capability);
  }
  usbredirparser_init(parser_.get(), "guest of a test", capabilities.data(), USB_REDIR_CAPS_SIZE,
                      0);
}

void RedirGuest::listen_to_parser() {
  usbredirparser& p = *parser_;
  p.priv = this;
  p.log_func = [](void*, int, const char*) {};
  p.read_func = [](void* guest, std::uint8_t* data, int count) {
    const ssize_t got =
        ::recv(self(guest).socket_.get(), data, static_cast<std::size_t>(count), MSG_DONTWAIT);
    if (got > 0) return static_cast<int>(got);
    return got < 0 && errno == EAGAIN ? 0 : -1;
  };
  p.write_func = [](void* guest, std::uint8_t* data, int count) {
    const ssize_t gone = ::send(self(guest).socket_.get(), data, static_cast<std::size_t>(count),
                                MSG_DONTWAIT | MSG_NOSIGNAL);
    if (gone >= 0) return static_cast<int>(gone);
    return errno == EAGAIN ? 0 : -1;
  };
  p.hello_func = [](void*, usb_redir_hello_header*) {};
  p.interface_info_func = [](void*, usb_redir_interface_info_header*) {};
  p.ep_info_func = [](void*, usb_redir_ep_info_header*) {};
  p.device_connect_func = [](void* guest, usb_redir_device_connect_header*) {
    self(guest).has_device_ = true;
  };
  p.device_disconnect_func = [](void* guest) {
    self(guest).has_device_ = false;
    self(guest).transfers_.clear();
    ++self(guest).disconnects_;
  };
  p.configuration_status_func = [](void* guest, std::uint64_t,
                                   usb_redir_configuration_status_header* header) {
    self(guest).reply_ = Reply{header->status, {header->configuration}};
  };
  p.control_packet_func = [](void* guest, std::uint64_t, usb_redir_control_packet_header* header,
                             std::uint8_t* data, int count) {
    self(guest).reply_ = Reply{header->status, Bytes(data, data + count)};
    usbredirparser_free_packet_data(self(guest).parser_.get(), data);
  };
  p.bulk_packet_func = [](void* guest, std::uint64_t id, usb_redir_bulk_packet_header* header,
                          std::uint8_t* data, int count) {
    self(guest).on_bulk(id, *header, {data, static_cast<std::size_t>(count)});
    usbredirparser_free_packet_data(self(guest).parser_.get(), data);
  };
}

bool RedirGuest::pump() {
  usbredirparser* parser = parser_.get();
  const bool unsent = usbredirparser_has_data_to_write(parser) > 0;
  if (unsent && usbredirparser_do_write(parser) != 0) return false;
  pollfd interest{socket_.get(), POLLIN, 0};
  if (::poll(&interest, 1, 2) <= 0) return true;
  return usbredirparser_do_read(parser) != usbredirparser_read_io_error;
}

bool RedirGuest::pump_until(const std::function<bool()>& reached) {
  const std::array<RedirGuest*, 1> alone{this};
  return pump_all(alone, reached);
}

std::optional<RedirGuest::Bytes> RedirGuest::control(std::uint8_t type, std::uint8_t request,
                                                     std::uint16_t value, std::uint16_t index,
                                                     std::uint16_t length, const Bytes& data) {
  const bool in = (type & 0x80U) != 0;
  usb_redir_control_packet_header header{};
  header.endpoint = in ? 0x80 : 0x00;
  header.request = request;
  header.requesttype = type;
  header.value = value;
  header.index = index;
  header.length = length;
  Bytes out = data;
  reply_.reset();
  usbredirparser_send_control_packet(parser_.get(), next_id_++, &header,
                                     out.empty() ? nullptr : out.data(),
                                     static_cast<int>(out.size()));
  if (!pump_until([this] { return reply_.has_value(); })) return std::nullopt;
  if (reply_->status != usb_redir_success) return std::nullopt;
  return reply_->data;
}

bool RedirGuest::set_configuration(std::uint8_t configuration) {
  usb_redir_set_configuration_header header{configuration};
  reply_.reset();
  usbredirparser_send_set_configuration(parser_.get(), next_id_++, &header);
  return pump_until([this] { return reply_.has_value(); }) && reply_->status == usb_redir_success &&
         reply_->data == Bytes{configuration};
}

bool RedirGuest::set_exposure(std::uint16_t exposure_100us, std::uint16_t gain_percent) {
  const auto low = [](std::uint16_t v) { return static_cast<std::uint8_t>(v); };
  const auto high = [](std::uint16_t v) { return static_cast<std::uint8_t>(v >> 8U); };
  return control(0x21, 1, 0x0200, 0x0100, 1, {1}) &&
         control(0x21, 1, 0x0400, 0x0100, 4, {low(exposure_100us), high(exposure_100us), 0, 0}) &&
         control(0x21, 1, 0x0400, 0x0200, 2, {low(gain_percent), high(gain_percent)});
}

bool RedirGuest::begin_stream(int transfers, std::uint32_t room) {
  const auto parameters = control(0xa1, 0x81, 0x0100, 1, 26);
  if (!parameters || parameters->size() != 26) return false;
  if (!control(0x21, 1, 0x0200, 1, 26, *parameters)) return false;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    largest |= std::size_t{(*parameters)[kLargestPayloadAt + i]} << (8 * i);
  }
  stream_.emplace(largest);
  for (int i = 0; i < transfers; ++i) hand_in(room);
  return true;
}

void RedirGuest::hand_in(std::uint32_t room) {
  room_ = room;
  usb_redir_bulk_packet_header header{};
  header.endpoint = kStream;
  header.length = static_cast<std::uint16_t>(room);
  header.length_high = static_cast<std::uint16_t>(room >> 16U);
  transfers_.insert(next_id_);
  usbredirparser_send_bulk_packet(parser_.get(), next_id_++, &header, nullptr, 0);
}

void RedirGuest::on_bulk(std::uint64_t id, const usb_redir_bulk_packet_header& header,
                         std::span<const std::uint8_t> data) {
  if (transfers_.erase(id) == 0) return;
  if (header.status == usb_redir_cancelled) ++cancelled_;
  if (header.status != usb_redir_success) return;
  stream_->take(data, room_);
  if (again_) hand_in(room_);
}

void RedirGuest::cancel_all() {
  for (const std::uint64_t id : transfers_) {
    usbredirparser_send_cancel_data_packet(parser_.get(), id);
  }
}

void RedirGuest::reset() {
  usbredirparser_send_reset(parser_.get());
}

bool pump_all(std::span<RedirGuest* const> guests, const std::function<bool()>& reached) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!reached()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    for (RedirGuest* guest : guests) {
      if (!guest->pump()) return false;
    }
  }
  return true;
}

}  // namespace dottrack::test
