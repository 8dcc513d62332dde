#pragma once
// The memory of one camera's frames: what the camera writes into, and the grey made of it.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "drivers/libcamera/luma.h"
#include "drivers/libcamera/picture.h"
#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace dottrack::drivers {

// A buffer, mapped for reading from construction to destruction, whether or not the camera is still
// there. Starts at the buffer's first byte, wherever in its file that is.
class Mapping {
 public:
  static Result<Mapping> of(int fd, std::size_t offset, std::size_t length);
  ~Mapping();
  Mapping(Mapping&& other) noexcept;
  Mapping& operator=(Mapping&&) = delete;

  std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  Mapping(void* at, std::size_t mapped, std::span<const std::uint8_t> bytes)
      : at_(at), mapped_(mapped), bytes_(bytes) {}

  void* at_;
  std::size_t mapped_;
  std::span<const std::uint8_t> bytes_;
};

class FrameMemory {
 public:
  FrameMemory(const Picture& format, std::vector<Mapping> mappings);

  std::size_t buffers() const { return mappings_.size(); }

  // After the camera has written into a buffer: makes the grey, where it does not lie there as it
  // is. False when it is not a whole picture. May allocate; one thread.
  bool accept(std::size_t buffer, std::size_t bytes_used);

  // Of a buffer that was accepted. Any thread, no allocation.
  ImageView image(std::size_t buffer) const;

 private:
  Picture format_;
  std::vector<Mapping> mappings_;
  std::vector<std::vector<std::uint8_t>> grey_;  // one a buffer; empty when used in place
  std::unique_ptr<JpegLuma> jpeg_;
};

}  // namespace dottrack::drivers
