#pragma once
// The pictures of cameras: DIR/<camera>/<tick>.pgm, or DIR/<camera>.pgm.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace dottrack::calibrate {

struct CameraPictures {
  std::string name;
  std::vector<std::filesystem::path> files;              // in the order of their names
  std::map<std::size_t, std::filesystem::path> of_tick;  // those whose names are numbers
};

// Cameras in the order of their names, numbers in them by their value. Folders without pictures are
// no cameras. An error says that there are none.
Result<std::vector<CameraPictures>> list_pictures(const std::filesystem::path& folder);

struct Picture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;

  ImageView view() const { return {pixels.data(), width_px, height_px, width_px}; }
};

// The error names the file.
Result<Picture> read_picture(const std::filesystem::path& file);

// The mean of pictures of one size, rounded: an unchanging scene with less noise.
Result<Picture> mean_picture(const std::vector<std::filesystem::path>& files);

}  // namespace dottrack::calibrate
