#pragma once
// The control side of an emulated camera: what it answers on endpoint 0.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/frame_grabber.h"
#include "host_sim/usb_cameras/uvc_descriptors.h"

namespace dottrack::host_sim {

struct ControlRequest {
  std::uint8_t type = 0;  // bmRequestType
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;
};

// Nothing: the request is stalled. A request to the device is answered by no bytes.
using ControlAnswer = std::optional<Bytes>;

// Exposure time in 100 us, gain in 1/100 (so that libcamera's gain is the factor). As on most
// cameras the exposure is automatic until it is switched off, and cannot be set before; here an
// automatic exposure is the one of the start. What a camera of these controls would not do (values
// out of range, units that are not there) is stalled, and the reason kept for who asks.
class UvcDevice {
 public:
  UvcDevice(const UvcFacts& facts, const hal::ExposureSettings& exposure);

  // `data`: what came with a request to the device.
  ControlAnswer control(const ControlRequest& request, std::span<const std::uint8_t> data);

  // Of the only configuration, 1; 0 is none.
  bool set_configuration(std::uint8_t configuration);
  std::uint8_t configuration() const { return configuration_; }
  // Every interface has setting 0 alone.
  bool set_interface(std::uint8_t interface, std::uint8_t setting);

  void reset();     // of the bus; the controls keep their values
  void power_up();  // as new

  // The host has committed to stream, and has not ended it.
  bool committed() const { return committed_; }
  const UvcFacts& facts() const { return facts_; }
  hal::ExposureSettings exposure() const;

 private:
  struct Control {
    std::uint8_t entity = 0;
    std::uint8_t selector = 0;
    std::uint8_t bytes = 0;
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    std::uint32_t step = 1;
    std::uint32_t initial = 0;  // that the device tells of: unity, for a gain
    std::uint32_t at_start = 0;
    std::uint32_t now = 0;
  };
  enum class Complaint : std::uint8_t {
    none = 0,
    wrong_state = 2,
    out_of_range = 4,
    unknown_unit = 5,
    unknown_control = 6,
    unknown_request = 7,
  };

  ControlAnswer standard(const ControlRequest& request);
  ControlAnswer descriptor(std::uint16_t value) const;
  ControlAnswer clear_halt(std::uint16_t endpoint);
  ControlAnswer video_control(const ControlRequest& request, std::span<const std::uint8_t> data);
  ControlAnswer video_streaming(const ControlRequest& request, std::span<const std::uint8_t> data);
  ControlAnswer complaint(const ControlRequest& request);
  ControlAnswer get(const Control& control, std::uint8_t request);
  ControlAnswer set(Control& control, std::span<const std::uint8_t> data);
  ControlAnswer refuse(Complaint why);
  Control* find(std::uint8_t entity, std::uint8_t selector);
  bool automatic() const;
  bool possible(const Control& control, std::uint32_t value) const;

  UvcFacts facts_;
  std::array<Control, 3> controls_;
  std::uint8_t configuration_ = 0;
  bool committed_ = false;
  Complaint complaint_ = Complaint::none;
};

}  // namespace dottrack::host_sim
