#include "drivers/libcamera/frame_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace dottrack::drivers {

Result<Mapping> Mapping::of(int fd, std::size_t offset, std::size_t length) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t before = offset % page;
  void* const at = ::mmap(nullptr, before + length, PROT_READ, MAP_SHARED, fd,
                          static_cast<off_t>(offset - before));
  if (at == MAP_FAILED) return fail(std::string("a buffer cannot be mapped: ") + strerror(errno));
  const auto* const first = static_cast<const std::uint8_t*>(at) + before;
  return Mapping(at, before + length, {first, length});
}

Mapping::~Mapping() {
  if (at_ != nullptr) ::munmap(at_, mapped_);
}

Mapping::Mapping(Mapping&& other) noexcept
    : at_(std::exchange(other.at_, nullptr)),
      mapped_(std::exchange(other.mapped_, 0)),
      bytes_(std::exchange(other.bytes_, {})) {}

FrameMemory::FrameMemory(const Picture& format, std::vector<Mapping> mappings)
    : format_(format), mappings_(std::move(mappings)) {
  if (format_.packing == Packing::grey) return;
  grey_.assign(mappings_.size(), std::vector<std::uint8_t>(format_.pixels()));
  if (format_.packing == Packing::mjpeg) jpeg_ = std::make_unique<JpegLuma>();
}

bool FrameMemory::accept(std::size_t buffer, std::size_t bytes_used) {
  const std::span<const std::uint8_t> bytes = mappings_[buffer].bytes();
  if (bytes_used < format_.needed_bytes() || bytes_used > bytes.size()) return false;
  switch (format_.packing) {
    case Packing::grey:
      return true;
    case Packing::yuyv:
      copy_yuyv_luma(bytes, format_.stride_bytes, format_.width_px, format_.height_px,
                     grey_[buffer]);
      return true;
    case Packing::mjpeg:
      return jpeg_->decode(bytes.first(bytes_used), format_.width_px, format_.height_px,
                           grey_[buffer]);
  }
  return false;
}

ImageView FrameMemory::image(std::size_t buffer) const {
  const bool in_place = grey_.empty();
  return {.data = in_place ? mappings_[buffer].bytes().data() : grey_[buffer].data(),
          .width_px = format_.width_px,
          .height_px = format_.height_px,
          .stride_bytes = in_place ? format_.stride_bytes : format_.width_px};
}

}  // namespace dottrack::drivers
