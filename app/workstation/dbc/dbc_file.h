#pragma once
// A DBC file: which signals lie where in which CAN message, and what they mean.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/can_frame.h"
#include "hal/base/result.h"

namespace dottrack::dbc {

inline constexpr std::size_t kMaxTextBytes = std::size_t{1} << 22U;
inline constexpr std::size_t kMaxMessageBytes = 64;

struct DbcSignal {
  std::string name;
  // Intel: the least significant bit. Motorola: the most significant one. Bit n is bit n % 8 of
  // byte n / 8, as in the file.
  unsigned start = 0;
  unsigned length = 1;  // bits, 1 to 64
  bool intel = true;
  bool is_signed = false;
  double factor = 1.0;  // physical value = raw value * factor + offset
  double offset = 0.0;
  double minimum = 0.0;
  double maximum = 0.0;
  std::string unit;
  std::vector<std::string> receivers;
  std::string comment;
  std::map<std::int64_t, std::string> values;  // raw value -> what it is called
};

struct DbcMessage {
  std::uint32_t id = 0;   // without the bit that marks an extended identifier
  bool extended = false;  // 29 bits
  std::string name;
  unsigned length_bytes = 0;
  std::string sender;
  std::string comment;
  std::vector<DbcSignal> signals;                 // in the order of the file
  std::map<std::string, std::string> attributes;  // as written: of an enumeration its number

  const DbcSignal* signal(std::string_view signal_name) const;
};

struct DbcFile {
  std::string version;
  std::string comment;
  std::vector<DbcMessage> messages;               // in the order of the file
  std::map<std::string, std::string> attributes;  // of the network

  const DbcMessage* find(std::uint32_t id, bool extended) const;
  const DbcMessage* find(std::string_view message_name) const;
};

// Sections that say nothing about the layout are passed over; multiplexed and floating-point
// signals are refused, for they cannot be decoded. An error is one line: `name:line: what is wrong;
// expected what`. Whatever the text is, memory stays proportional to it.
Result<DbcFile> parse_dbc(std::string_view text, const std::string& name);

struct DecodedSignal {
  const DbcSignal* signal = nullptr;
  std::int64_t raw = 0;  // an unsigned one of 64 bits: modulo 2^64
  double physical = 0.0;
  std::string_view text;  // what this value is called; empty: nothing
};

// Every signal that lies within the payload whole, in the order of the file. The views point into
// the message.
std::vector<DecodedSignal> decode(const DbcMessage& message, std::span<const std::uint8_t> payload);

// Nothing if the file has no message of that identifier.
std::optional<std::vector<DecodedSignal>> decode(const DbcFile& file, const hal::CanFrame& frame);

}  // namespace dottrack::dbc
