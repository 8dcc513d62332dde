#include "host_sim/usb_cameras/uvc_descriptors.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <span>

#include "host_sim/usb_cameras/little_endian.h"

namespace dottrack::host_sim {
namespace {

// Types of descriptors.
constexpr std::uint8_t kDevice = 1;
constexpr std::uint8_t kConfiguration = 2;
constexpr std::uint8_t kString = 3;
constexpr std::uint8_t kInterface = 4;
constexpr std::uint8_t kEndpoint = 5;
constexpr std::uint8_t kQualifier = 6;
constexpr std::uint8_t kAssociation = 0x0b;
constexpr std::uint8_t kVideo = 0x24;  // of the class; a subtype follows

constexpr std::uint16_t kCameraSensor = 0x0201;
constexpr std::uint16_t kUsbStreaming = 0x0101;
constexpr std::uint8_t kOutputTerminal = 3;
constexpr std::uint32_t kClock_hz = 48'000'000;
constexpr std::uint16_t kEnglish = 0x0409;
constexpr std::array<std::uint8_t, 16> kGrey8{'Y',  '8', '0', '0',  0x00, 0x00, 0x10, 0x00,
                                              0x80, 0,   0,   0xaa, 0x00, 0x38, 0x9b, 0x71};

// One descriptor: its length is put in front when it is complete.
class Descriptor {
 public:
  explicit Descriptor(std::initializer_list<std::uint8_t> type) {
    raw({type.begin(), type.size()});
  }
  Descriptor& u8(std::uint8_t value) { return number(value, 1); }
  Descriptor& u16(std::uint16_t value) { return number(value, 2); }
  Descriptor& u32(std::uint32_t value) { return number(value, 4); }
  Descriptor& zeros(std::size_t count) {
    length_ += count;
    return *this;
  }
  Descriptor& raw(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) bytes_.at(length_++) = byte;
    return *this;
  }
  Bytes bytes() const {
    Bytes all(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(length_));
    all[0] = static_cast<std::uint8_t>(length_);
    return all;
  }

 private:
  Descriptor& number(std::uint32_t value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i, value >>= 8U) {
      bytes_.at(length_++) = static_cast<std::uint8_t>(value);
    }
    return *this;
  }

  std::array<std::uint8_t, 255> bytes_{};  // a descriptor's length is one byte
  std::size_t length_ = 1;
};

void join(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

Bytes interface_descriptor(std::uint8_t number, std::uint8_t endpoints, std::uint8_t subclass) {
  return Descriptor({kInterface})
      .u8(number)
      .u8(0)
      .u8(endpoints)
      .u8(kVideoClass)
      .u8(subclass)
      .zeros(2)
      .bytes();
}

// A class-specific header tells the length of itself and of all that it heads.
Bytes headed(const Bytes& header, std::size_t length_at, const Bytes& units) {
  Bytes all = header;
  join(all, units);
  all[length_at] = static_cast<std::uint8_t>(all.size());
  all[length_at + 1] = static_cast<std::uint8_t>(all.size() >> 8U);
  return all;
}

Bytes video_control() {
  constexpr std::uint8_t kExposureModeAndTime = 0x0a;  // bits 1 and 3
  constexpr std::uint16_t kGain = 1U << 9U;
  Bytes units = Descriptor({kVideo, 2})
                    .u8(kCameraTerminal)
                    .u16(kCameraSensor)
                    .zeros(2 + 6)  // association, name, focal lengths
                    .u8(3)
                    .u8(kExposureModeAndTime)
                    .zeros(2)
                    .bytes();
  join(units, Descriptor({kVideo, 5})
                  .u8(kProcessingUnit)
                  .u8(kCameraTerminal)
                  .u16(0)
                  .u8(2)
                  .u16(kGain)
                  .u8(0)
                  .bytes());
  join(units, Descriptor({kVideo, 3})
                  .u8(kOutputTerminal)
                  .u16(kUsbStreaming)
                  .u8(0)
                  .u8(kProcessingUnit)
                  .u8(0)
                  .bytes());
  const Bytes header =
      Descriptor({kVideo, 1}).u16(0x0100).u16(0).u32(kClock_hz).u8(1).u8(kStreamInterface).bytes();
  return headed(header, 5, units);
}

Bytes frame_descriptor(const UvcFacts& facts) {
  const std::uint32_t interval = frame_interval_100ns(facts);
  const auto bit_rate =
      static_cast<std::uint32_t>(std::lround(8.0 * frame_bytes(facts) * facts.frame_rate_hz));
  return Descriptor({kVideo, 5})
      .u8(1)
      .u8(0)
      .u16(static_cast<std::uint16_t>(facts.width_px))
      .u16(static_cast<std::uint16_t>(facts.height_px))
      .u32(bit_rate)
      .u32(bit_rate)
      .u32(frame_bytes(facts))
      .u32(interval)
      .u8(1)
      .u32(interval)
      .bytes();
}

Bytes video_streaming(const UvcFacts& facts) {
  constexpr std::uint8_t kBitsPerPixel = 8;
  Bytes formats =
      Descriptor({kVideo, 4}).u8(1).u8(1).raw(kGrey8).u8(kBitsPerPixel).u8(1).zeros(4).bytes();
  join(formats, frame_descriptor(facts));
  join(formats, Descriptor({kVideo, 0x0d}).u8(1).u8(1).u8(4).bytes());  // BT.709, as sRGB
  const Bytes header = Descriptor({kVideo, 1})
                           .u8(1)
                           .u16(0)
                           .u8(kStreamEndpoint)
                           .u8(0)
                           .u8(kOutputTerminal)
                           .zeros(3)
                           .u8(1)
                           .u8(0)
                           .bytes();
  return headed(header, 4, formats);
}

Bytes text_descriptor(const std::string& text) {
  Descriptor descriptor({kString});
  for (const char letter : text) descriptor.u16(static_cast<std::uint8_t>(letter));
  return descriptor.bytes();
}

}  // namespace

std::uint32_t frame_bytes(const UvcFacts& facts) {
  return static_cast<std::uint32_t>(facts.width_px) * static_cast<std::uint32_t>(facts.height_px);
}

std::uint32_t frame_interval_100ns(const UvcFacts& facts) {
  return static_cast<std::uint32_t>(std::lround(1e7 / facts.frame_rate_hz));
}

Bytes device_descriptor() {
  return Descriptor({kDevice})
      .u16(0x0200)
      .u8(kMiscellaneousClass)
      .u8(2)
      .u8(1)
      .u8(kControlPacket_bytes)
      .u16(kUvcVendor)
      .u16(kUvcProduct)
      .u16(kUvcRelease)
      .u8(1)
      .u8(2)
      .u8(3)
      .u8(1)
      .bytes();
}

Bytes device_qualifier() {
  return Descriptor({kQualifier})
      .u16(0x0200)
      .u8(kMiscellaneousClass)
      .u8(2)
      .u8(1)
      .u8(kControlPacket_bytes)
      .u8(1)
      .u8(0)
      .bytes();
}

Bytes configuration_descriptor(const UvcFacts& facts) {
  constexpr std::uint8_t kBusPowered = 0x80;
  constexpr std::uint8_t kPower_2mA = 250;
  constexpr std::uint8_t kBulk = 2;
  const Bytes head =
      Descriptor({kConfiguration}).u16(0).u8(2).u8(1).u8(0).u8(kBusPowered).u8(kPower_2mA).bytes();
  Bytes body = Descriptor({kAssociation})
                   .u8(kControlInterface)
                   .u8(2)
                   .u8(kVideoClass)
                   .u8(3)  // a collection of video interfaces
                   .zeros(2)
                   .bytes();
  join(body, interface_descriptor(kControlInterface, 0, kVideoControlSubclass));
  join(body, video_control());
  join(body, interface_descriptor(kStreamInterface, 1, kVideoStreamingSubclass));
  join(body, video_streaming(facts));
  join(
      body,
      Descriptor({kEndpoint}).u8(kStreamEndpoint).u8(kBulk).u16(kStreamPacket_bytes).u8(0).bytes());
  return headed(head, 2, body);
}

Bytes string_descriptor(const UvcFacts& facts, std::uint8_t index) {
  switch (index) {
    case 0:
      return Descriptor({kString}).u16(kEnglish).bytes();
    case 1:
      return text_descriptor("dottrack");
    case 2:
      return text_descriptor(facts.product);
    case 3:
      return text_descriptor(facts.serial);
    default:
      return {};
  }
}

Bytes stream_parameters(const UvcFacts& facts) {
  const std::uint32_t frame = frame_bytes(facts);
  Bytes bytes{0, 0, 1, 1};  // no hints; format 1, frame 1
  append(bytes, frame_interval_100ns(facts), 4);
  append(bytes, 0, 5 * 2);  // key frames, quality, windows, delay: of compressed video
  append(bytes, frame, 4);
  append(bytes, frame + kPayloadHeader_bytes, 4);
  return bytes;
}

}  // namespace dottrack::host_sim
