// Fuzz target: the reader of DBC files, and frames decoded by them. An input that begins with a
// zero byte is frames for dottrack.dbc; any other is a DBC file, whose messages then decode its own
// bytes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "app/workstation/dbc/dbc_file.h"
#include "app/workstation/dbc/dottrack_dbc.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/dbc_promises.h"
#include "tests/fuzz/require.h"

namespace dottrack::fuzz {
namespace {

constexpr std::size_t kMaxMessages = 16;  // of a file that are tried: to be quick

const dbc::DbcFile& own_layout() {
  static const dbc::DbcFile kLayout = [] {
    auto parsed = dbc::parse_dbc(dbc::dottrack_dbc(), "dottrack.dbc");
    require(parsed.has_value(), "dottrack.dbc can be read");
    return *parsed;
  }();
  return kLayout;
}

hal::CanFrame frame_from(ByteSource& source) {
  hal::CanFrame frame;
  const std::uint8_t choice = source.byte();
  frame.id = 0x300U + (choice & 63U);
  frame.extended = (choice & 128U) != 0;
  if ((choice & 64U) != 0) frame.id = static_cast<std::uint32_t>(source.number(4));
  frame.length = source.byte();
  source.fill(std::span(frame.data).first(std::min<std::size_t>(frame.length, 64)));
  return frame;
}

void decode_frames(ByteSource source) {
  while (!source.empty()) {
    const hal::CanFrame frame = frame_from(source);
    const auto decoded = dbc::decode(own_layout(), frame);
    const dbc::DbcMessage* message = own_layout().find(frame.id, frame.extended);
    require(decoded.has_value() == (message != nullptr), "what the file has is decoded");
    const auto length = std::min<std::size_t>(frame.length, frame.data.size());
    if (decoded) check_decoded(*message, *decoded, std::span(frame.data).first(length));
  }
}

void read_file(std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto file = dbc::parse_dbc(text, "fuzzed.dbc");
  if (!file) {
    require(file.error().message.starts_with("fuzzed.dbc:"), "an error names file and line");
    require(file.error().message.find('\n') == std::string::npos, "an error is one line");
    return;
  }
  check_file(*file);
  const std::size_t messages = std::min(file->messages.size(), kMaxMessages);
  for (std::size_t i = 0; i < messages; ++i) {
    const auto payload = bytes.last(std::min<std::size_t>(bytes.size(), 64 - i));
    const dbc::DbcMessage& message = file->messages[i];
    check_decoded(message, dbc::decode(message, payload), payload);
  }
}

}  // namespace
}  // namespace dottrack::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  if (size > 0 && data[0] == 0) {
    dottrack::fuzz::decode_frames(dottrack::fuzz::ByteSource(bytes.subspan(1)));
  } else {
    dottrack::fuzz::read_file(bytes);
  }
  return 0;
}
