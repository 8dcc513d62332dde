#include "app/config/camera_file.h"

#include "app/config/complaint.h"
#include "app/config/text_file.h"

namespace dottrack::config {

Result<CameraFile> read_camera_file(const std::filesystem::path& path) {
  const Result<std::string> text = read_text_file(path);
  if (!text) {
    Complaint complaint(path.string());
    complaint.add(0, text.error().message, "a camera model in JPL's text format");
    return tl::unexpected<Error>(complaint.first());
  }
  return parse_camera_text(*text, path.string());
}

}  // namespace dottrack::config
