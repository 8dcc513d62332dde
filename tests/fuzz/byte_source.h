#pragma once
// The fuzzer's bytes, taken one after the other; zeros when there are none left.

#include <cstddef>
#include <cstdint>
#include <span>

namespace dottrack::fuzz {

class ByteSource {
 public:
  explicit ByteSource(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool empty() const { return next_ >= bytes_.size(); }
  std::uint8_t byte() { return empty() ? std::uint8_t{0} : bytes_[next_++]; }
  bool flag() { return (byte() & 1U) != 0; }
  std::uint64_t number(std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value = value << 8U | byte();
    return value;
  }
  void fill(std::span<std::uint8_t> into) {
    for (auto& value : into) value = byte();
  }
  std::span<const std::uint8_t> rest() const { return bytes_.subspan(next_); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

}  // namespace dottrack::fuzz
