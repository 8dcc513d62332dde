#pragma once
// Memory as a camera's driver would share it, without a camera.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "drivers/libcamera/frame_memory.h"

namespace dottrack::test {

// A file in memory that holds some buffers, one behind the other, from an odd offset on.
class SharedBuffers {
 public:
  SharedBuffers(std::size_t buffers, std::size_t bytes) : buffers_(buffers), bytes_(bytes) {
    fd_ = ::memfd_create("frames", 0);
    EXPECT_EQ(::ftruncate(fd_, static_cast<off_t>(kOffset + buffers * bytes)), 0);
  }
  ~SharedBuffers() { ::close(fd_); }
  SharedBuffers(const SharedBuffers&) = delete;
  SharedBuffers& operator=(const SharedBuffers&) = delete;

  void write(std::size_t buffer, std::span<const std::uint8_t> content) const {
    const auto written = ::pwrite(fd_, content.data(), content.size(),
                                  static_cast<off_t>(kOffset + buffer * bytes_));
    EXPECT_EQ(written, static_cast<ssize_t>(content.size()));
  }

  std::unique_ptr<drivers::FrameMemory> map(const drivers::Picture& picture) const {
    std::vector<drivers::Mapping> mappings;
    for (std::size_t buffer = 0; buffer < buffers_; ++buffer) {
      auto mapping = drivers::Mapping::of(fd_, kOffset + buffer * bytes_, bytes_);
      EXPECT_TRUE(mapping);
      mappings.push_back(std::move(*mapping));
    }
    return std::make_unique<drivers::FrameMemory>(picture, std::move(mappings));
  }

 private:
  static constexpr std::size_t kOffset = 100;

  std::size_t buffers_;
  std::size_t bytes_;
  int fd_ = -1;
};

}  // namespace dottrack::test
