#pragma once
// A host's side of a bulk video stream: transfers back to frames.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dottrack::test {

class UvcReassembly {
 public:
  // `largest_payload_bytes`: as agreed on with the camera.
  explicit UvcReassembly(std::size_t largest_payload_bytes)
      : largest_payload_bytes_(largest_payload_bytes) {}

  // A transfer of at most `room` bytes. A payload ends with one that is not full, or when it is as
  // large as can be.
  void take(std::span<const std::uint8_t> piece, std::size_t room) {
    std::span<const std::uint8_t> pixels = piece;
    if (!in_payload_ && !piece.empty()) {
      begin_payload(piece);
      pixels = piece.subspan(piece[0]);
    }
    frame_.insert(frame_.end(), pixels.begin(), pixels.end());
    payload_bytes_ += piece.size();
    if (piece.size() < room || payload_bytes_ >= largest_payload_bytes_) end_payload();
  }

  const std::vector<std::vector<std::uint8_t>>& frames() const { return frames_; }

 private:
  void begin_payload(std::span<const std::uint8_t> piece) {
    in_payload_ = true;
    payload_bytes_ = 0;
    const bool id = (piece[1] & 0x01U) != 0;
    if (id != frame_id_) frame_.clear();  // what was there of another frame will never be whole
    frame_id_ = id;
    last_ = (piece[1] & 0x02U) != 0;
  }
  void end_payload() {
    in_payload_ = false;
    if (!last_) return;
    last_ = false;
    frames_.push_back(std::move(frame_));
    frame_.clear();
  }

  std::size_t largest_payload_bytes_;
  bool in_payload_ = false;
  bool frame_id_ = false;
  bool last_ = false;
  std::size_t payload_bytes_ = 0;
  std::vector<std::uint8_t> frame_;
  std::vector<std::vector<std::uint8_t>> frames_;
};

}  // namespace dottrack::test
