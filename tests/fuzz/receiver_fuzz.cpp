// Fuzz target: the receiver for vehicles. The input is a program: settings, then frames of every
// kind, waits and polls.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/checked_receiver.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/sealed_group.h"

namespace dottrack::fuzz {
namespace {

dottrack_settings settings_from(ByteSource& source) {
  dottrack_settings settings = dottrack_default_settings();
  const std::uint8_t choice = source.byte();
  settings.extended = (choice & 2U) != 0;
  const std::uint32_t bases = (settings.extended ? 0x20000000U : 0x800U) - DOTTRACK_IDENTIFIERS + 1;
  if ((choice & 1U) != 0) settings.base_id = static_cast<std::uint32_t>(source.number(4)) % bases;
  if ((choice & 4U) != 0) settings.age_limit_us = static_cast<std::uint32_t>(source.number(4));
  if ((choice & 8U) != 0) settings.group_timeout_us = static_cast<std::uint32_t>(source.number(4));
  if ((choice & 16U) != 0) settings.restart_gap_us = static_cast<std::uint32_t>(source.number(4));
  return settings;
}

class Session {
 public:
  explicit Session(ByteSource& source) : source_(source), receiver_(settings_from(source)) {}

  void step() {
    switch (source_.byte() % 12) {
      case 0:
        return receiver_.wait(source_.number(2));
      case 1:
        return receiver_.wait(source_.number(3) * 16);
      case 2:
        return receiver_.wait(source_.number(8));
      case 3:
        return receiver_.poll();
      case 4:
        return push_any();
      case 5:
        return push_sealed();
      case 6:
        return push_group(false);
      case 7:
        return push_group(true);
      case 8:
        return push_again();
      case 9:
        return push_damaged();
      case 10:
        sequence_ = source_.byte();
        return;
      default:
        return read_others();
    }
  }

 private:
  void push(const dottrack_frame& frame) {
    receiver_.push(frame);
    last_[next_++ % last_.size()] = frame;
  }

  dottrack_frame any_frame() {
    dottrack_frame frame{};
    const std::uint8_t choice = source_.byte();
    frame.id = (choice & 1U) != 0 ? static_cast<std::uint32_t>(source_.number(4))
                                  : receiver_.settings().base_id + (choice >> 2U);
    frame.extended = receiver_.settings().extended != ((choice & 2U) != 0);
    frame.length = source_.byte();
    source_.fill(std::span(frame.data).first(std::min<std::size_t>(frame.length, 64)));
    return frame;
  }

  void push_any() { push(any_frame()); }

  // One frame with a right checksum and any content.
  void push_sealed() {
    const std::uint8_t choice = source_.byte();
    const std::uint32_t offset = choice & (DOTTRACK_IDENTIFIERS - 1U);
    if ((choice & 0x80U) != 0) ++sequence_;
    push(sealed_frame(receiver_.settings(), offset, sequence_, source_));
  }

  // A group as the unit sends it, with any content that a group may have; perhaps not all of it.
  void push_group(bool fd) {
    const std::uint8_t left_out = source_.byte();
    capture_us_ += source_.number(3);
    const SealedGroup group =
        sealed_group(receiver_.settings(), ++sequence_, capture_us_, fd, source_);
    for (std::size_t i = 0; i < group.count; ++i) {
      if (i + 1 != left_out) push(group.frames[i]);
    }
  }

  const dottrack_frame& one_of_last() { return last_[source_.byte() % last_.size()]; }

  void push_again() { push(one_of_last()); }

  void push_damaged() {
    dottrack_frame frame = one_of_last();
    const std::uint8_t bit = source_.byte();
    auto& byte = frame.data[bit / 8U % 64U];
    byte = static_cast<std::uint8_t>(byte ^ 1U << bit % 8U);
    if (source_.flag()) frame.length = source_.byte();
    push(frame);
  }

  // What needs no receiver: replies, commands, words.
  void read_others() {
    const std::uint8_t number = source_.byte();
    const dottrack_frame command = dottrack_command_frame(
        &receiver_.settings(), static_cast<dottrack_command>(number % 3 + 1), source_.byte(),
        static_cast<std::uint16_t>(source_.number(2)), source_.byte());
    require(is_sealed(command, 18), "a command has a right checksum");
    push(command);
    dottrack_reply reply{};
    dottrack_read_reply(&receiver_.settings(), &one_of_last(), &reply);
    for (const auto text : {dottrack_state_text, dottrack_reason_text, dottrack_health_text,
                            dottrack_result_text, dottrack_light_text, dottrack_iris_text}) {
      require(text(number) != nullptr, "there is a word for every number");
    }
    require(dottrack_degraded_text(number) != nullptr, "there is a word for every bit");
    require(dottrack_verdict_text(static_cast<dottrack_verdict>(number % 8)) != nullptr,
            "there is a word for every verdict");
  }

  ByteSource& source_;
  CheckedReceiver receiver_;
  std::uint8_t sequence_ = 0;
  std::uint64_t capture_us_ = 0;
  std::array<dottrack_frame, 8> last_{};
  std::size_t next_ = 0;
};

}  // namespace
}  // namespace dottrack::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dottrack::fuzz::ByteSource source({data, size});
  dottrack::fuzz::Session session(source);
  while (!source.empty()) session.step();
  return 0;
}
