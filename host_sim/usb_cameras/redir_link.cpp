#include "host_sim/usb_cameras/redir_link.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace dottrack::host_sim {
namespace {

constexpr std::size_t kMostTransfers = 1024;  // a host keeps a handful waiting
constexpr std::size_t kEndpoints = 32;        // the ones out, then the ones in

std::size_t index_of(std::uint8_t endpoint) {
  return (endpoint & 0x0fU) + ((endpoint & 0x80U) != 0 ? kEndpoints / 2 : 0);
}

usb_redir_interface_info_header interfaces() {
  usb_redir_interface_info_header info{};
  info.interface_count = 2;
  info.interface[0] = kControlInterface;
  info.interface_class[0] = kVideoClass;
  info.interface_subclass[0] = kVideoControlSubclass;
  info.interface[1] = kStreamInterface;
  info.interface_class[1] = kVideoClass;
  info.interface_subclass[1] = kVideoStreamingSubclass;
  return info;
}

usb_redir_ep_info_header endpoints() {
  usb_redir_ep_info_header info{};
  std::fill_n(static_cast<std::uint8_t*>(info.type), kEndpoints,
              static_cast<std::uint8_t>(usb_redir_type_invalid));
  for (const std::uint8_t endpoint : {std::uint8_t{0x00}, std::uint8_t{0x80}}) {
    info.type[index_of(endpoint)] = usb_redir_type_control;
    info.max_packet_size[index_of(endpoint)] = kControlPacket_bytes;
  }
  const std::size_t stream = index_of(kStreamEndpoint);
  info.type[stream] = usb_redir_type_bulk;
  info.interface[stream] = kStreamInterface;
  info.max_packet_size[stream] = kStreamPacket_bytes;
  return info;
}

void log_nothing(void*, int, const char*) {}

}  // namespace

RedirLink::RedirLink(rtos::FileDescriptor socket, UvcDevice& device, bool plugged)
    : socket_(std::move(socket)),
      device_(device),
      parser_(usbredirparser_create()),
      plugged_(plugged) {
  listen_to_parser();
  std::array<std::uint32_t, USB_REDIR_CAPS_SIZE> capabilities{};
  for (const int capability :
       {usb_redir_cap_connect_device_version, usb_redir_cap_64bits_ids,
        usb_redir_cap_ep_info_max_packet_size, usb_redir_cap_32bits_bulk_length}) {
    usbredirparser_caps_set_cap(capabilities.data(), capability);
  }
  usbredirparser_init(parser_.get(), "dottrack cameras", capabilities.data(), USB_REDIR_CAPS_SIZE,
                      usbredirparser_fl_usb_host);
}

void RedirLink::listen_to_parser() {
  usbredirparser& p = *parser_;
  p.priv = this;
  p.log_func = log_nothing;
  p.read_func = [](void* link, std::uint8_t* data, int count) {
    return self(link).read(data, count);
  };
  p.write_func = [](void* link, std::uint8_t* data, int count) {
    return self(link).write(data, count);
  };
  p.hello_func = [](void* link, usb_redir_hello_header*) {
    self(link).greeted_ = true;
    self(link).announce();
  };
  p.reset_func = [](void* link) { self(link).on_reset(); };
  p.set_configuration_func = [](void* link, std::uint64_t id,
                                usb_redir_set_configuration_header* header) {
    self(link).on_set_configuration(id, header->configuration);
  };
  p.get_configuration_func = [](void* link, std::uint64_t id) {
    self(link).on_get_configuration(id);
  };
  p.set_alt_setting_func = [](void* link, std::uint64_t id,
                              usb_redir_set_alt_setting_header* header) {
    self(link).on_set_interface(id, *header);
  };
  p.get_alt_setting_func = [](void* link, std::uint64_t id,
                              usb_redir_get_alt_setting_header* header) {
    self(link).on_get_interface(id, *header);
  };
  p.cancel_data_packet_func = [](void* link, std::uint64_t id) { self(link).on_cancel(id); };
  p.control_packet_func = [](void* link, std::uint64_t id, usb_redir_control_packet_header* header,
                             std::uint8_t* data, int count) {
    self(link).on_control(id, *header, {data, static_cast<std::size_t>(count)});
    usbredirparser_free_packet_data(self(link).parser_.get(), data);
  };
  p.bulk_packet_func = [](void* link, std::uint64_t id, usb_redir_bulk_packet_header* header,
                          std::uint8_t* data, int) {
    self(link).on_bulk(id, *header);
    usbredirparser_free_packet_data(self(link).parser_.get(), data);
  };
}

bool RedirLink::receive() {
  // A packet that the parser does not understand is skipped; the connection goes on.
  return usbredirparser_do_read(parser_.get()) != usbredirparser_read_io_error;
}

bool RedirLink::flush() {
  return !has_unsent() || usbredirparser_do_write(parser_.get()) == 0;
}

int RedirLink::read(std::uint8_t* data, int count) {
  const ssize_t got = recv(socket(), data, static_cast<std::size_t>(count), MSG_DONTWAIT);
  if (got > 0) return static_cast<int>(got);
  return got < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : -1;
}

int RedirLink::write(const std::uint8_t* data, int count) {
  const ssize_t gone =
      send(socket(), data, static_cast<std::size_t>(count), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (gone >= 0) return static_cast<int>(gone);
  return errno == EAGAIN || errno == EINTR ? 0 : -1;
}

void RedirLink::announce() {
  if (!greeted_ || !plugged_) return;
  device_.power_up();
  usb_redir_interface_info_header info = interfaces();
  usbredirparser_send_interface_info(parser_.get(), &info);
  usb_redir_ep_info_header endpoint_info = endpoints();
  usbredirparser_send_ep_info(parser_.get(), &endpoint_info);
  usb_redir_device_connect_header connect{usb_redir_speed_high, kMiscellaneousClass, 2,          1,
                                          kUvcVendor,           kUvcProduct,         kUvcRelease};
  usbredirparser_send_device_connect(parser_.get(), &connect);
}

void RedirLink::plug_in() {
  if (std::exchange(plugged_, true)) return;
  announce();
}

void RedirLink::unplug() {
  if (!std::exchange(plugged_, false)) return;
  streaming_ = false;
  transfers_.clear();
  device_.power_up();
  if (greeted_) usbredirparser_send_device_disconnect(parser_.get());
}

std::size_t RedirLink::room() const {
  return transfers_.empty() || has_unsent() ? 0 : transfers_.front().room;
}

void RedirLink::answer(std::span<const std::uint8_t> piece) {
  const Transfer transfer = transfers_.front();
  transfers_.pop_front();
  end_transfer(transfer, usb_redir_success, piece);
}

void RedirLink::end_transfer(const Transfer& transfer, std::uint8_t status,
                             std::span<const std::uint8_t> piece) {
  usb_redir_bulk_packet_header header{};
  header.endpoint = kStreamEndpoint;
  header.status = status;
  header.length = static_cast<std::uint16_t>(piece.size());
  header.length_high = static_cast<std::uint16_t>(piece.size() >> 16U);
  // The parser copies the bytes; that they are not const is its interface's age.
  usbredirparser_send_bulk_packet(parser_.get(), transfer.id, &header,
                                  const_cast<std::uint8_t*>(piece.data()),  // NOLINT
                                  static_cast<int>(piece.size()));
}

void RedirLink::on_bulk(std::uint64_t id, const usb_redir_bulk_packet_header& header) {
  const Transfer transfer{id, header.length | std::uint32_t{header.length_high} << 16U};
  const bool possible = plugged_ && header.endpoint == kStreamEndpoint &&
                        transfer.room > kPayloadHeader_bytes && transfers_.size() < kMostTransfers;
  if (!possible) {
    usb_redir_bulk_packet_header refused = header;
    refused.status = usb_redir_stall;
    refused.length = refused.length_high = 0;
    usbredirparser_send_bulk_packet(parser_.get(), id, &refused, nullptr, 0);
    return;
  }
  transfers_.push_back(transfer);
  streaming_ = device_.committed();
}

void RedirLink::on_reset() {
  device_.reset();
  streaming_ = false;
  for (const Transfer& transfer : transfers_) end_transfer(transfer, usb_redir_cancelled, {});
  transfers_.clear();
}

// A host takes its transfers back when it ends the stream.
void RedirLink::on_cancel(std::uint64_t id) {
  const auto found = std::find_if(transfers_.begin(), transfers_.end(),
                                  [&](const Transfer& transfer) { return transfer.id == id; });
  if (found == transfers_.end()) return;
  const Transfer transfer = *found;
  transfers_.erase(found);
  streaming_ = false;
  end_transfer(transfer, usb_redir_cancelled, {});
}

void RedirLink::on_control(std::uint64_t id, const usb_redir_control_packet_header& header,
                           std::span<const std::uint8_t> data) {
  const bool in = (header.endpoint & 0x80U) != 0;
  ControlAnswer answer = device_.control(
      {header.requesttype, header.request, header.value, header.index, header.length}, data);
  if (!device_.committed()) streaming_ = false;
  usb_redir_control_packet_header reply = header;
  reply.status = answer ? usb_redir_success : usb_redir_stall;
  if (!answer) answer.emplace();
  if (in || reply.status == usb_redir_stall) {
    reply.length = static_cast<std::uint16_t>(answer->size());
  }
  usbredirparser_send_control_packet(parser_.get(), id, &reply,
                                     answer->empty() ? nullptr : answer->data(),
                                     static_cast<int>(answer->size()));
}

void RedirLink::on_set_configuration(std::uint64_t id, std::uint8_t configuration) {
  const bool done = device_.set_configuration(configuration);
  streaming_ = false;
  usb_redir_configuration_status_header status{};
  status.status = done ? usb_redir_success : usb_redir_stall;
  status.configuration = device_.configuration();
  usbredirparser_send_configuration_status(parser_.get(), id, &status);
}

void RedirLink::on_get_configuration(std::uint64_t id) {
  usb_redir_configuration_status_header status{usb_redir_success, device_.configuration()};
  usbredirparser_send_configuration_status(parser_.get(), id, &status);
}

void RedirLink::on_set_interface(std::uint64_t id, const usb_redir_set_alt_setting_header& header) {
  const bool done = device_.set_interface(header.interface, header.alt);
  if (!device_.committed()) streaming_ = false;
  usb_redir_alt_setting_status_header status{};
  status.status = done ? usb_redir_success : usb_redir_stall;
  status.interface = header.interface;
  status.alt = 0;
  usbredirparser_send_alt_setting_status(parser_.get(), id, &status);
}

void RedirLink::on_get_interface(std::uint64_t id, const usb_redir_get_alt_setting_header& header) {
  usb_redir_alt_setting_status_header status{usb_redir_success, header.interface, 0};
  usbredirparser_send_alt_setting_status(parser_.get(), id, &status);
}

}  // namespace dottrack::host_sim
