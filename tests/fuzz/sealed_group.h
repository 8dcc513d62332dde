#pragma once
// Groups of frames in the unit's order, their content from the fuzzer but for what binds them.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/sealed_frame.h"

namespace dottrack::fuzz {

struct SealedGroup {
  std::array<dottrack_frame, DOTTRACK_IDENTIFIERS> frames{};
  std::size_t count = 0;
};

// The frame of base_id + offset, any content.
dottrack_frame sealed_frame(const dottrack_settings& settings, std::uint32_t offset,
                            std::uint8_t sequence, ByteSource& source);

// Version, state, a unit quaternion and the follow bits make sense unless the source says
// otherwise.
SealedGroup sealed_group(const dottrack_settings& settings, std::uint8_t sequence,
                         std::uint64_t capture_us, bool fd, ByteSource& source);

}  // namespace dottrack::fuzz
