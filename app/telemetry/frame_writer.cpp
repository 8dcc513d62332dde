#include "app/telemetry/frame_writer.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace dottrack::telemetry {
namespace {

namespace fs = std::filesystem;

Result<void> write_pgm(const fs::path& path, const ImageView& image) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return tl::unexpected<Error>(file.error());
  file->write(fmt::format("P5\n{} {}\n255\n", image.width_px, image.height_px));
  for (int y = 0; y < image.height_px; ++y) {
    file->write(
        {reinterpret_cast<const char*>(image.row(y)), static_cast<std::size_t>(image.width_px)});
  }
  return file->finish();
}

}  // namespace

FrameWriter::FrameWriter(fs::path folder, std::vector<std::string> cameras, OutputFile times)
    : folder_(std::move(folder)), cameras_(std::move(cameras)), times_(std::move(times)) {}

Result<std::unique_ptr<FrameWriter>> FrameWriter::open(const fs::path& folder,
                                                       std::vector<std::string> cameras) {
  for (const std::string& camera : cameras) {
    std::error_code error;
    fs::create_directories(folder / camera, error);
    if (error) {
      return fail(fmt::format("{}: cannot make this folder ({})", (folder / camera).string(),
                              error.message()));
    }
  }
  Result<OutputFile> times = OutputFile::create(folder / "times.csv");
  if (!times) return tl::unexpected<Error>(times.error());
  times->write("tick,camera,mid_exposure_ns,arrival_ns\n");
  return std::unique_ptr<FrameWriter>(
      new FrameWriter(folder, std::move(cameras), std::move(*times)));
}

Result<void> FrameWriter::write(std::uint64_t tick, const FrameCopy& copy) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!copy.delivered.contains(i)) continue;
    const fs::path path = folder_ / cameras_[i] / fmt::format("{:06}.pgm", tick);
    if (auto done = write_pgm(path, copy.frames[i].image); !done) return done;
    times_.write(fmt::format("{},{},{},{}\n", tick, cameras_[i],
                             copy.frames[i].mid_exposure.time_since_epoch().count(),
                             copy.copied.time_since_epoch().count()));
  }
  return times_.flush();
}

}  // namespace dottrack::telemetry
