#pragma once
// What dbc_layout.h, made from dottrack.dbc, is written in.

#include <cstdint>
#include <string_view>

#include "app/core/protocol/can_payload.h"

namespace dottrack::protocol::layout {

struct Message {
  std::uint32_t offset = 0;   // from the base identifier
  unsigned length = 0;        // bytes
  std::uint16_t data_id = 0;  // of end-to-end protection

  // The message of the same layout so many identifiers further.
  constexpr Message further(std::uint32_t identifiers) const {
    return {offset + identifiers, length, static_cast<std::uint16_t>(data_id + identifiers)};
  }
  constexpr bool operator==(const Message&) const = default;
};

// A raw number is what the field holds: two's complement of the field's length if it is signed.
struct Signal : Field {
  bool is_signed = false;
  bool has_not_available = false;
  double factor = 1.0;  // physical = raw * factor

  constexpr double steps_per_unit() const { return 1.0 / factor; }
  // The largest raw number that is a value; of a signed signal the least is its negative.
  constexpr std::int64_t largest() const {
    if (is_signed) return signed_max();
    return static_cast<std::int64_t>(mask()) - (has_not_available ? 1 : 0);
  }
  constexpr std::uint64_t not_available() const {
    return is_signed ? std::uint64_t{1} << (length - 1U) : mask();
  }
};

struct NamedSignal {
  Message message;
  Signal signal;
  std::string_view name;
};

}  // namespace dottrack::protocol::layout
