#pragma once
// Frames whose protection is right, so that a fuzzer gets past the checksum. Written from the
// profiles' definitions, not with the encoder's or the receiver's code.

#include <cstdint>

#include "app/core/protocol/receiver/dottrack_receiver.h"

namespace dottrack::fuzz {

inline constexpr std::uint32_t kFdPoseOffset = 16;

// Writes the checksum for a message at base_id + offset over what the frame holds: E2E profile 2 in
// a frame of 8 bytes, profile 5 in one of 64. Other lengths stay as they are.
void seal(dottrack_frame& frame, std::uint32_t offset);

// Its length and checksum are those of the message at base_id + offset.
bool is_sealed(const dottrack_frame& frame, std::uint32_t offset);

}  // namespace dottrack::fuzz
