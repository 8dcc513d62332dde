#pragma once
// One connection with an emulator's usb-redir device: the usbredir protocol, spoken as the side
// that has the USB device.

#include <usbredirparser.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <span>

#include "host_sim/usb_cameras/uvc_device.h"
#include "rtos_shim/posix_rt/file_descriptor.h"

namespace dottrack::host_sim {

// Never blocks. The emulator speaks first of all (its hello); the device is announced after that,
// while it is plugged in.
class RedirLink {
 public:
  // `socket`: connected, non-blocking. `device` outlives this.
  RedirLink(rtos::FileDescriptor socket, UvcDevice& device, bool plugged);
  RedirLink(const RedirLink&) = delete;
  RedirLink& operator=(const RedirLink&) = delete;
  ~RedirLink() = default;

  int socket() const { return socket_.get(); }
  // False when the other side is gone.
  bool receive();
  bool flush();
  bool has_unsent() const { return usbredirparser_has_data_to_write(parser_.get()) > 0; }

  void plug_in();
  void unplug();

  // The host has committed to stream and asked for data since.
  bool streaming() const { return streaming_; }
  // Bytes that the oldest transfer has room for; 0 when none waits, or what went before has not
  // left for the emulator yet.
  std::size_t room() const;
  // Ends the oldest transfer.
  void answer(std::span<const std::uint8_t> piece);

 private:
  struct Transfer {
    std::uint64_t id = 0;
    std::uint32_t room = 0;
  };
  struct Destroy {
    void operator()(usbredirparser* parser) const { usbredirparser_destroy(parser); }
  };

  static RedirLink& self(void* link) { return *static_cast<RedirLink*>(link); }
  void listen_to_parser();
  void announce();

  int read(std::uint8_t* data, int count);
  int write(const std::uint8_t* data, int count);
  void on_control(std::uint64_t id, const usb_redir_control_packet_header& header,
                  std::span<const std::uint8_t> data);
  void on_bulk(std::uint64_t id, const usb_redir_bulk_packet_header& header);
  void on_reset();
  void on_cancel(std::uint64_t id);
  void on_set_configuration(std::uint64_t id, std::uint8_t configuration);
  void on_get_configuration(std::uint64_t id);
  void on_set_interface(std::uint64_t id, const usb_redir_set_alt_setting_header& header);
  void on_get_interface(std::uint64_t id, const usb_redir_get_alt_setting_header& header);
  void end_transfer(const Transfer& transfer, std::uint8_t status,
                    std::span<const std::uint8_t> piece);

  rtos::FileDescriptor socket_;
  UvcDevice& device_;
  std::unique_ptr<usbredirparser, Destroy> parser_;
  std::deque<Transfer> transfers_;
  bool plugged_;
  bool greeted_ = false;
  bool streaming_ = false;
};

}  // namespace dottrack::host_sim
