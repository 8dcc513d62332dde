#include "host_sim/usb_cameras/uvc_device.h"

#include <algorithm>
#include <cmath>

#include "host_sim/usb_cameras/little_endian.h"

namespace dottrack::host_sim {
namespace {

// bmRequestType: direction, kind, recipient.
constexpr std::uint8_t kToHost = 0x80;
constexpr std::uint8_t kOfClass = 0x20;
constexpr std::uint8_t kKindMask = 0x60;
constexpr std::uint8_t kDevice = 0x00;
constexpr std::uint8_t kInterface = 0x01;
constexpr std::uint8_t kEndpoint = 0x02;

// Standard requests.
constexpr std::uint8_t kGetStatus = 0;
constexpr std::uint8_t kClearFeature = 1;
constexpr std::uint8_t kGetDescriptor = 6;
constexpr std::uint8_t kGetConfiguration = 8;
constexpr std::uint8_t kSetConfiguration = 9;
constexpr std::uint8_t kGetInterface = 10;
constexpr std::uint8_t kSetInterface = 11;
constexpr std::uint16_t kEndpointHalt = 0;

// Requests of the video class.
constexpr std::uint8_t kSetCurrent = 0x01;
constexpr std::uint8_t kGetCurrent = 0x81;
constexpr std::uint8_t kGetLow = 0x82;
constexpr std::uint8_t kGetHigh = 0x83;
constexpr std::uint8_t kGetStep = 0x84;
constexpr std::uint8_t kGetLength = 0x85;
constexpr std::uint8_t kGetInfo = 0x86;
constexpr std::uint8_t kGetInitial = 0x87;

constexpr std::uint8_t kMayGetAndSet = 0x03;
constexpr std::uint8_t kDisabledByAutomatic = 0x04;

// Selectors.
constexpr std::uint8_t kErrorCode = 2;     // of interface 0 itself
constexpr std::uint8_t kExposureMode = 2;  // of the camera terminal
constexpr std::uint8_t kExposureTime = 4;
constexpr std::uint8_t kGain = 4;  // of the processing unit
constexpr std::uint8_t kProbe = 1;
constexpr std::uint8_t kCommit = 2;

constexpr std::uint32_t kManual = 1;
constexpr std::uint32_t kAperturePriority = 8;
constexpr std::uint32_t kUnity = 100;
constexpr std::uint32_t kHighestGain = 400;
constexpr std::uint32_t kLongestExposure = 5000;

constexpr std::size_t kMode = 0;  // of controls_
constexpr std::size_t kTime = 1;
constexpr std::size_t kFactor = 2;

Bytes number(std::uint32_t value, std::size_t count) {
  Bytes bytes;
  append(bytes, value, count);
  return bytes;
}

std::uint8_t low_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>(value);
}

std::uint8_t high_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>(value >> 8U);
}

std::uint32_t rounded(double value, std::uint32_t low, std::uint32_t high) {
  return static_cast<std::uint32_t>(
      std::lround(std::clamp(value, static_cast<double>(low), static_cast<double>(high))));
}

}  // namespace

UvcDevice::UvcDevice(const UvcFacts& facts, const hal::ExposureSettings& exposure) : facts_(facts) {
  const std::uint32_t longest =
      std::clamp(frame_interval_100ns(facts) / 1000, std::uint32_t{1}, kLongestExposure);
  const std::uint32_t time = rounded(to_seconds(exposure.exposure) * 1e4, 1, longest);
  const std::uint32_t gain = rounded(exposure.gain * kUnity, kUnity, kHighestGain);
  // The step of the exposure mode tells which modes there are.
  controls_[kMode] = {.entity = kCameraTerminal,
                      .selector = kExposureMode,
                      .bytes = 1,
                      .low = kManual,
                      .high = kAperturePriority,
                      .step = kManual | kAperturePriority,
                      .initial = kAperturePriority,
                      .at_start = kAperturePriority};
  controls_[kTime] = {kCameraTerminal, kExposureTime, 4, 1, longest, 1, time, time};
  controls_[kFactor] = {kProcessingUnit, kGain, 2, kUnity, kHighestGain, 1, kUnity, gain};
  for (Control& control : controls_) control.now = control.at_start;
}

ControlAnswer UvcDevice::control(const ControlRequest& request,
                                 std::span<const std::uint8_t> data) {
  ControlAnswer answer;
  if ((request.type & kKindMask) == 0) {
    answer = standard(request);
  } else if ((request.type & ~kToHost) == (kOfClass | kInterface)) {
    const std::uint8_t interface = low_byte(request.index);
    if (interface == kControlInterface) answer = video_control(request, data);
    if (interface == kStreamInterface) answer = video_streaming(request, data);
  }
  if (answer && answer->size() > request.length) answer->resize(request.length);
  return answer;
}

ControlAnswer UvcDevice::standard(const ControlRequest& request) {
  switch (request.type << 8U | request.request) {
    case (kToHost | kDevice) << 8U | kGetDescriptor:
      return descriptor(request.value);
    case (kToHost | kDevice) << 8U | kGetStatus:
    case (kToHost | kInterface) << 8U | kGetStatus:
    case (kToHost | kEndpoint) << 8U | kGetStatus:
      return Bytes{0, 0};
    case (kToHost | kDevice) << 8U | kGetConfiguration:
      return Bytes{configuration_};
    case kDevice << 8U | kSetConfiguration:
      return set_configuration(low_byte(request.value)) ? ControlAnswer(Bytes{}) : std::nullopt;
    case (kToHost | kInterface) << 8U | kGetInterface:
      return request.index <= kStreamInterface ? ControlAnswer(Bytes{0}) : std::nullopt;
    case kInterface << 8U | kSetInterface:
      return set_interface(low_byte(request.index), low_byte(request.value))
                 ? ControlAnswer(Bytes{})
                 : std::nullopt;
    case kEndpoint << 8U | kClearFeature:
      return request.value == kEndpointHalt ? clear_halt(request.index) : std::nullopt;
    default:
      return std::nullopt;
  }
}

ControlAnswer UvcDevice::descriptor(std::uint16_t value) const {
  Bytes bytes;
  switch (high_byte(value)) {
    case 1:
      bytes = device_descriptor();
      break;
    case 2:
      if (low_byte(value) == 0) bytes = configuration_descriptor(facts_);
      break;
    case 3:
      bytes = string_descriptor(facts_, low_byte(value));
      break;
    case 6:
      bytes = device_qualifier();
      break;
    default:
      break;
  }
  if (bytes.empty()) return std::nullopt;
  return bytes;
}

// A host that streams over a bulk endpoint ends it by this, as there is no setting to go back to.
ControlAnswer UvcDevice::clear_halt(std::uint16_t endpoint) {
  if (endpoint == kStreamEndpoint) committed_ = false;
  return Bytes{};
}

bool UvcDevice::set_configuration(std::uint8_t configuration) {
  if (configuration > 1) return false;
  configuration_ = configuration;
  committed_ = false;
  return true;
}

bool UvcDevice::set_interface(std::uint8_t interface, std::uint8_t setting) {
  if (interface > kStreamInterface || setting != 0) return false;
  if (interface == kStreamInterface) committed_ = false;
  return true;
}

void UvcDevice::reset() {
  configuration_ = 0;
  committed_ = false;
}

void UvcDevice::power_up() {
  reset();
  for (Control& control : controls_) control.now = control.at_start;
  complaint_ = Complaint::none;
}

hal::ExposureSettings UvcDevice::exposure() const {
  const std::uint32_t time = automatic() ? controls_[kTime].at_start : controls_[kTime].now;
  return {std::chrono::microseconds(100) * time, controls_[kFactor].now / double{kUnity}};
}

ControlAnswer UvcDevice::video_control(const ControlRequest& request,
                                       std::span<const std::uint8_t> data) {
  const std::uint8_t entity = high_byte(request.index);
  const std::uint8_t selector = high_byte(request.value);
  if (entity == 0) return selector == kErrorCode ? complaint(request) : std::nullopt;
  complaint_ = Complaint::none;
  if (entity != kCameraTerminal && entity != kProcessingUnit) {
    return refuse(Complaint::unknown_unit);
  }
  Control* control = find(entity, selector);
  if (control == nullptr) return refuse(Complaint::unknown_control);
  const bool to_host = (request.type & kToHost) != 0;
  if (!to_host && request.request == kSetCurrent) return set(*control, data);
  return to_host ? get(*control, request.request) : refuse(Complaint::unknown_request);
}

ControlAnswer UvcDevice::complaint(const ControlRequest& request) {
  if (request.request == kGetCurrent) return Bytes{static_cast<std::uint8_t>(complaint_)};
  if (request.request == kGetInfo) return Bytes{0x01};
  return std::nullopt;
}

ControlAnswer UvcDevice::get(const Control& control, std::uint8_t request) {
  switch (request) {
    case kGetCurrent:
      return number(control.now, control.bytes);
    case kGetLow:
      return number(control.low, control.bytes);
    case kGetHigh:
      return number(control.high, control.bytes);
    case kGetStep:
      return number(control.step, control.bytes);
    case kGetInitial:
      return number(control.initial, control.bytes);
    case kGetLength:
      return number(control.bytes, 2);
    case kGetInfo: {
      const bool disabled = &control == &controls_[kTime] && automatic();
      return Bytes{
          static_cast<std::uint8_t>(kMayGetAndSet | (disabled ? kDisabledByAutomatic : 0))};
    }
    default:
      return refuse(Complaint::unknown_request);
  }
}

ControlAnswer UvcDevice::set(Control& control, std::span<const std::uint8_t> data) {
  if (data.size() != control.bytes) return refuse(Complaint::unknown_request);
  const std::uint32_t value = number_of(data);
  if (&control == &controls_[kTime] && automatic()) return refuse(Complaint::wrong_state);
  if (!possible(control, value)) return refuse(Complaint::out_of_range);
  control.now = value;
  return Bytes{};
}

ControlAnswer UvcDevice::refuse(Complaint why) {
  complaint_ = why;
  return std::nullopt;
}

UvcDevice::Control* UvcDevice::find(std::uint8_t entity, std::uint8_t selector) {
  const auto found = std::find_if(controls_.begin(), controls_.end(), [&](const Control& control) {
    return control.entity == entity && control.selector == selector;
  });
  return found == controls_.end() ? nullptr : &*found;
}

bool UvcDevice::automatic() const {
  return controls_[kMode].now != kManual;
}

bool UvcDevice::possible(const Control& control, std::uint32_t value) const {
  if (&control == &controls_[kMode]) return value == kManual || value == kAperturePriority;
  return control.low <= value && value <= control.high;
}

// There is one format to agree on: whatever the host proposes, this is it.
ControlAnswer UvcDevice::video_streaming(const ControlRequest& request,
                                         std::span<const std::uint8_t> data) {
  const Bytes parameters = stream_parameters(facts_);
  const std::uint8_t selector = high_byte(request.value);
  if (high_byte(request.index) != 0 || (selector != kProbe && selector != kCommit)) {
    return std::nullopt;
  }
  switch (request.request) {
    case kSetCurrent:
      if (data.size() != parameters.size()) return std::nullopt;
      if (selector == kCommit) committed_ = true;
      return Bytes{};
    case kGetCurrent:
    case kGetLow:
    case kGetHigh:
    case kGetInitial:
      return parameters;
    case kGetLength:
      return number(static_cast<std::uint32_t>(parameters.size()), 2);
    case kGetInfo:
      return Bytes{kMayGetAndSet};
    default:
      return std::nullopt;
  }
}

}  // namespace dottrack::host_sim
