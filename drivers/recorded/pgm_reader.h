#pragma once
// Binary 8-bit PGM images, read strictly.

#include <cstdint>
#include <filesystem>
#include <span>

#include "hal/base/result.h"

namespace dottrack::drivers {

// Reads a P5 image with maxval 255 and of exactly width_px x height_px into `pixels`, which holds
// that many bytes, row by row. Anything else (another kind, size or depth, too few bytes or too
// many) is an error of one line that names the file, what it is and what was expected; `pixels` is
// then unspecified.
Result<void> read_pgm(const std::filesystem::path& path, int width_px, int height_px,
                      std::span<std::uint8_t> pixels);

struct PgmSize {
  int width_px = 0;
  int height_px = 0;
};

// What the header says. Anything but P5, maxval 255 and at most 32768 pixels each way is an error
// of one line, as above.
Result<PgmSize> read_pgm_size(const std::filesystem::path& path);

}  // namespace dottrack::drivers
