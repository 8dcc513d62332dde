#include "drivers/libcamera/picture_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <libcamera/formats.h>

#include <algorithm>
#include <array>

namespace dottrack::drivers {
namespace {

using libcamera::PixelFormat;
using libcamera::StreamConfiguration;

struct Known {
  PixelFormat format;
  Packing packing;
};

// In order of preference.
constexpr std::array kKnown{
    Known{libcamera::formats::R8, Packing::grey},
    Known{libcamera::formats::NV12, Packing::grey},
    Known{libcamera::formats::NV21, Packing::grey},
    Known{libcamera::formats::YUV420, Packing::grey},
    Known{libcamera::formats::YUV422, Packing::grey},
    Known{libcamera::formats::YUYV, Packing::yuyv},
    Known{libcamera::formats::MJPEG, Packing::mjpeg},
};

std::unique_ptr<libcamera::CameraConfiguration> configuration_for(libcamera::Camera& camera,
                                                                  libcamera::StreamRole role) {
  auto configuration = camera.generateConfiguration({role});
  if (configuration && configuration->empty()) configuration.reset();
  return configuration;
}

bool offers(const StreamConfiguration& stream, const PixelFormat& format) {
  const std::vector<PixelFormat> formats = stream.formats().pixelformats();
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

// Whether the camera takes exactly this; the configuration is then ready for use.
bool accepts(libcamera::CameraConfiguration& configuration, const PixelFormat& format,
             const libcamera::Size& size, unsigned buffers) {
  StreamConfiguration& stream = configuration.at(0);
  stream.pixelFormat = format;
  stream.size = size;
  stream.bufferCount = std::max(stream.bufferCount, buffers);
  return configuration.validate() != libcamera::CameraConfiguration::Invalid &&
         configuration.size() == 1 && configuration.at(0).pixelFormat == format &&
         configuration.at(0).size == size;
}

std::vector<std::string> sizes_of(const StreamConfiguration& stream) {
  std::vector<std::string> sizes;
  for (const Known& known : kKnown) {
    if (!offers(stream, known.format)) continue;
    for (const libcamera::Size& size : stream.formats().sizes(known.format)) {
      sizes.push_back(size.toString() + " " + known.format.toString());
    }
  }
  return sizes;
}

std::string what_else(const StreamConfiguration& stream) {
  std::vector<std::string> names;
  for (const PixelFormat& format : stream.formats().pixelformats()) {
    names.push_back(format.toString());
  }
  return fmt::format("no format that holds 8-bit grey; it offers {}", fmt::join(names, ", "));
}

}  // namespace

Picture ChosenFormat::picture() const {
  const StreamConfiguration& stream = configuration->at(0);
  return {.packing = packing,
          .width_px = static_cast<int>(stream.size.width),
          .height_px = static_cast<int>(stream.size.height),
          .stride_bytes = static_cast<std::ptrdiff_t>(stream.stride)};
}

Result<ChosenFormat> choose_format(libcamera::Camera& camera, int width_px, int height_px,
                                   unsigned buffers) {
  const libcamera::Size size(static_cast<unsigned>(width_px), static_cast<unsigned>(height_px));
  std::string refusal = "no stream for pictures";
  for (const auto role :
       {libcamera::StreamRole::Viewfinder, libcamera::StreamRole::VideoRecording}) {
    auto configuration = configuration_for(camera, role);
    if (!configuration) continue;
    for (const Known& known : kKnown) {
      if (!offers(configuration->at(0), known.format)) continue;
      if (accepts(*configuration, known.format, size, buffers)) {
        return ChosenFormat{std::move(configuration), known.packing};
      }
    }
    const std::vector<std::string> sizes = sizes_of(configuration->at(0));
    refusal = sizes.empty() ? what_else(configuration->at(0))
                            : fmt::format("no {}x{} pictures; it offers {}", width_px, height_px,
                                          fmt::join(sizes, ", "));
  }
  return fail(refusal);
}

std::vector<std::string> offered_sizes(libcamera::Camera& camera) {
  for (const auto role :
       {libcamera::StreamRole::Viewfinder, libcamera::StreamRole::VideoRecording}) {
    const auto configuration = configuration_for(camera, role);
    if (configuration) return sizes_of(configuration->at(0));
  }
  return {};
}

}  // namespace dottrack::drivers
