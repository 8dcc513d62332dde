#include "app/workstation/calibrate/input/picture_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "drivers/recorded/pgm_reader.h"

namespace dottrack::calibrate {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// "cam2" before "cam10".
bool comes_before(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto number_end = [](const std::string& s, std::size_t at) {
        while (at < s.size() && is_digit(s[at])) ++at;
        return at;
      };
      const std::size_t i_end = number_end(a, i);
      const std::size_t j_end = number_end(b, j);
      while (i < i_end && a[i] == '0') ++i;
      while (j < j_end && b[j] == '0') ++j;
      if (i_end - i != j_end - j) return i_end - i < j_end - j;
      const int order = a.compare(i, i_end - i, b, j, j_end - j);
      if (order != 0) return order < 0;
      i = i_end;
      j = j_end;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

bool is_picture(const fs::path& path) {
  std::error_code ignored;
  return path.extension() == ".pgm" && fs::is_regular_file(path, ignored);
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    entries.push_back(at->path());
  }
  std::sort(entries.begin(), entries.end(), [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().string(), b.filename().string());
  });
  return entries;
}

CameraPictures pictures_in(const fs::path& folder) {
  CameraPictures camera{folder.filename().string(), {}, {}};
  for (const fs::path& file : entries_of(folder)) {
    if (!is_picture(file)) continue;
    camera.files.push_back(file);
    const std::string stem = file.stem().string();
    std::size_t tick = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), tick);
    if (error == std::errc() && end == stem.data() + stem.size()) camera.of_tick[tick] = file;
  }
  return camera;
}

}  // namespace

Result<std::vector<CameraPictures>> list_pictures(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return fail(fmt::format("{}: no such folder; expected one with the cameras' pictures",
                            folder.string()));
  }
  std::vector<CameraPictures> cameras;
  for (const fs::path& entry : entries_of(folder)) {
    if (is_picture(entry)) {
      cameras.push_back({entry.stem().string(), {entry}, {}});
    } else if (fs::is_directory(entry, ignored)) {
      CameraPictures camera = pictures_in(entry);
      if (!camera.files.empty()) cameras.push_back(std::move(camera));
    }
  }
  if (cameras.empty()) {
    return fail(fmt::format(
        "{}: no pictures; expected <camera>.pgm or <camera>/<tick, six digits>.pgm, 8-bit grey",
        folder.string()));
  }
  return cameras;
}

Result<Picture> read_picture(const fs::path& file) {
  const auto size = drivers::read_pgm_size(file);
  if (!size) return tl::unexpected<Error>(size.error());
  Picture picture{size->width_px, size->height_px, {}};
  picture.pixels.resize(static_cast<std::size_t>(picture.width_px) *
                        static_cast<std::size_t>(picture.height_px));
  const auto read = drivers::read_pgm(file, picture.width_px, picture.height_px, picture.pixels);
  if (!read) return tl::unexpected<Error>(read.error());
  return picture;
}

Result<Picture> mean_picture(const std::vector<fs::path>& files) {
  auto picture = read_picture(files.front());
  if (!picture || files.size() == 1) return picture;
  std::vector<std::uint32_t> sums(picture->pixels.begin(), picture->pixels.end());
  for (std::size_t i = 1; i < files.size(); ++i) {
    const auto read =
        drivers::read_pgm(files[i], picture->width_px, picture->height_px, picture->pixels);
    if (!read) return tl::unexpected<Error>(read.error());
    for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += picture->pixels[p];
  }
  const auto n = static_cast<std::uint32_t>(files.size());
  for (std::size_t p = 0; p < sums.size(); ++p) {
    picture->pixels[p] = static_cast<std::uint8_t>((sums[p] + n / 2) / n);
  }
  return picture;
}

}  // namespace dottrack::calibrate
