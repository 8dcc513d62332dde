#pragma once
// A camera and the socket it is plugged into.

#include <poll.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "hal/base/result.h"
#include "hal/frame_grabber.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/usb_cameras/redir_link.h"
#include "host_sim/usb_cameras/uvc_device.h"
#include "host_sim/usb_cameras/uvc_frame.h"
#include "rtos_shim/posix_rt/file_descriptor.h"

namespace dottrack::host_sim {

// Listens for one emulator at a time; when that one goes, for the next. Never blocks.
class CameraPort {
 public:
  // Takes the place of a socket that an earlier run has left at this path.
  static Result<std::unique_ptr<CameraPort>> open(const std::filesystem::path& path,
                                                  const UvcFacts& facts,
                                                  const hal::ExposureSettings& exposure);
  ~CameraPort();
  CameraPort(const CameraPort&) = delete;
  CameraPort& operator=(const CameraPort&) = delete;

  // What to wait for.
  pollfd interest() const;
  // Does what interest() was answered with.
  void serve(short events);

  void plug_in();
  void unplug();

  bool streaming() const { return link_ && link_->streaming(); }
  hal::ExposureSettings exposure() const { return device_.exposure(); }
  std::uint64_t frames_sent() const { return frames_sent_; }
  std::uint64_t frames_skipped() const { return frames_skipped_; }

  // The next frame; left out, and counted, while the one before is on its way.
  void show(std::shared_ptr<const GreyImage> picture);
  // False when there is nothing to send, or nowhere to.
  bool send_piece();

 private:
  CameraPort(const std::filesystem::path& path, rtos::FileDescriptor listener,
             const UvcFacts& facts, const hal::ExposureSettings& exposure);
  void accept();
  void hang_up();
  void settle();

  std::filesystem::path path_;
  rtos::FileDescriptor listener_;
  UvcDevice device_;
  std::unique_ptr<RedirLink> link_;
  UvcFrame frame_;
  bool plugged_ = true;
  std::uint64_t frames_sent_ = 0;
  std::uint64_t frames_skipped_ = 0;
};

}  // namespace dottrack::host_sim
