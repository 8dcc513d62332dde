#pragma once
// What a DBC file that could be read fulfils, and what decoding a payload by it gives.

#include <cstdint>
#include <span>
#include <vector>

#include "app/workstation/dbc/dbc_file.h"

namespace dottrack::fuzz {

void check_file(const dbc::DbcFile& file);

// By a second way to take bits out of a payload.
void check_decoded(const dbc::DbcMessage& message, const std::vector<dbc::DecodedSignal>& decoded,
                   std::span<const std::uint8_t> payload);

}  // namespace dottrack::fuzz
