#include "app/workstation/dbc/dbc_file.h"

#include <algorithm>

#include "app/workstation/dbc/dbc_parser.h"

namespace dottrack::dbc {
namespace {

bool bit_of(std::span<const std::uint8_t> payload, unsigned bit) {
  return ((unsigned{payload[bit / 8]} >> (bit % 8)) & 1U) != 0;
}

// Least significant bit first.
std::uint64_t intel_bits(std::span<const std::uint8_t> payload, const DbcSignal& signal) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < signal.length; ++i) {
    value |= std::uint64_t{bit_of(payload, signal.start + i)} << i;
  }
  return value;
}

// Most significant bit first: down to bit 0 of a byte, then on from bit 7 of the next one.
std::uint64_t motorola_bits(std::span<const std::uint8_t> payload, const DbcSignal& signal) {
  std::uint64_t value = 0;
  unsigned bit = signal.start;
  for (unsigned i = 0; i < signal.length; ++i) {
    value = value << 1U | std::uint64_t{bit_of(payload, bit)};
    bit = bit % 8 == 0 ? bit + 15 : bit - 1;
  }
  return value;
}

bool lies_within(const DbcSignal& signal, std::size_t bytes) {
  const unsigned from_front =
      signal.intel ? signal.start : signal.start / 8 * 8 + 7 - signal.start % 8;
  return signal.length >= 1 && signal.length <= 64 &&
         std::size_t{from_front} + signal.length <= bytes * 8;
}

std::int64_t sign_extended(std::uint64_t value, unsigned length) {
  const std::uint64_t sign = std::uint64_t{1} << (length - 1);
  return static_cast<std::int64_t>((value ^ sign) - sign);
}

DecodedSignal read(std::span<const std::uint8_t> payload, const DbcSignal& signal) {
  const std::uint64_t bits =
      signal.intel ? intel_bits(payload, signal) : motorola_bits(payload, signal);
  DecodedSignal decoded;
  decoded.signal = &signal;
  decoded.raw =
      signal.is_signed ? sign_extended(bits, signal.length) : static_cast<std::int64_t>(bits);
  const double number =
      signal.is_signed ? static_cast<double>(decoded.raw) : static_cast<double>(bits);
  decoded.physical = number * signal.factor + signal.offset;
  const auto named = signal.values.find(decoded.raw);
  if (named != signal.values.end()) decoded.text = named->second;
  return decoded;
}

}  // namespace

const DbcSignal* DbcMessage::signal(std::string_view signal_name) const {
  const auto found = std::ranges::find(signals, signal_name, &DbcSignal::name);
  return found == signals.end() ? nullptr : &*found;
}

const DbcMessage* DbcFile::find(std::uint32_t id, bool extended) const {
  const auto found = std::ranges::find_if(messages, [&](const DbcMessage& message) {
    return message.id == id && message.extended == extended;
  });
  return found == messages.end() ? nullptr : &*found;
}

const DbcMessage* DbcFile::find(std::string_view message_name) const {
  const auto found = std::ranges::find(messages, message_name, &DbcMessage::name);
  return found == messages.end() ? nullptr : &*found;
}

Result<DbcFile> parse_dbc(std::string_view text, const std::string& name) {
  if (text.size() > kMaxTextBytes)
    return fail(name + ": is larger than 4 MiB; expected a DBC file");
  return Parser(text, name).parse();
}

std::vector<DecodedSignal> decode(const DbcMessage& message,
                                  std::span<const std::uint8_t> payload) {
  std::vector<DecodedSignal> decoded;
  decoded.reserve(message.signals.size());
  for (const DbcSignal& signal : message.signals) {
    if (lies_within(signal, payload.size())) decoded.push_back(read(payload, signal));
  }
  return decoded;
}

std::optional<std::vector<DecodedSignal>> decode(const DbcFile& file, const hal::CanFrame& frame) {
  const DbcMessage* message = file.find(frame.id, frame.extended);
  if (message == nullptr) return std::nullopt;
  const std::size_t bytes = std::min<std::size_t>(frame.length, frame.data.size());
  return decode(*message, std::span(frame.data).first(bytes));
}

}  // namespace dottrack::dbc
