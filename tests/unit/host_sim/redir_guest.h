#pragma once
// A guest behind an emulated USB port: the other side of the usbredir protocol, and enough of a
// video driver to take frames. Everything happens in pump(), in the caller's thread.

#include <usbredirparser.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "rtos_shim/posix_rt/file_descriptor.h"
#include "tests/unit/host_sim/uvc_reassembly.h"

namespace dottrack::test {

class RedirGuest {
 public:
  using Bytes = std::vector<std::uint8_t>;

  // Connects and greets.
  explicit RedirGuest(const std::filesystem::path& socket);
  RedirGuest(const RedirGuest&) = delete;
  RedirGuest& operator=(const RedirGuest&) = delete;
  ~RedirGuest() = default;

  // Handles what has come, or waits for it for some milliseconds. False when the other side hung
  // up.
  bool pump();
  // False when it does not come true in time.
  bool pump_until(const std::function<bool()>& reached);

  bool has_device() const { return has_device_; }
  int disconnects() const { return disconnects_; }

  // Nothing: stalled, or no answer.
  std::optional<Bytes> control(std::uint8_t type, std::uint8_t request, std::uint16_t value,
                               std::uint16_t index, std::uint16_t length, const Bytes& data = {});
  bool set_configuration(std::uint8_t configuration);
  // Switches automatic exposure off.
  bool set_exposure(std::uint16_t exposure_100us, std::uint16_t gain_percent);

  // Agrees on the format, and hands in transfers; each is handed in again when it is done.
  bool begin_stream(int transfers = 4, std::uint32_t room = 512);
  void hand_in(std::uint32_t room);
  void hand_in_again(bool again) { again_ = again; }
  void cancel_all();
  void reset();
  std::size_t waiting() const { return transfers_.size(); }
  int cancelled() const { return cancelled_; }

  const std::vector<Bytes>& frames() const { return stream_->frames(); }

 private:
  struct Destroy {
    void operator()(usbredirparser* parser) const { usbredirparser_destroy(parser); }
  };
  struct Reply {
    std::uint8_t status = 0;
    Bytes data;
  };

  static RedirGuest& self(void* guest) { return *static_cast<RedirGuest*>(guest); }
  void listen_to_parser();
  void on_bulk(std::uint64_t id, const usb_redir_bulk_packet_header& header,
               std::span<const std::uint8_t> data);

  rtos::FileDescriptor socket_;
  std::unique_ptr<usbredirparser, Destroy> parser_;
  std::uint64_t next_id_ = 1;
  bool has_device_ = false;
  int disconnects_ = 0;
  int cancelled_ = 0;
  bool again_ = true;
  std::uint32_t room_ = 512;
  std::optional<Reply> reply_;
  std::set<std::uint64_t> transfers_;
  std::optional<UvcReassembly> stream_;
};

// All of them in turn, until it is reached; false when it is not in time.
bool pump_all(std::span<RedirGuest* const> guests, const std::function<bool()>& reached);

}  // namespace dottrack::test
