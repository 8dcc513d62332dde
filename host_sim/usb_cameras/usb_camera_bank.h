#pragma once
// The cameras of a scene as USB Video Class devices for an emulated board: one socket a camera, on
// which the emulator's usb-redir device speaks the usbredir protocol.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "hal/base/time.h"
#include "hal/frame_grabber.h"
#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/sensor.h"

namespace dottrack::host_sim {

// One exposure of all cameras together.
struct Barrier {
  std::uint64_t index = 0;
  double scene_time_s = 0.0;  // of the middle of the exposure
  Time released{};            // on this machine's monotonic clock: when the frames went out
};

struct UsbCameraSetup {
  std::filesystem::path folder;  // of the sockets: folder/cam0, folder/cam1, ...
  std::vector<std::string> names;
  int width_px = 640;
  int height_px = 480;
  double frame_rate_hz = 3.0;
  hal::ExposureSettings exposure{.exposure = std::chrono::milliseconds(4), .gain = 1.0};
  std::uint64_t seed = 1;  // of the pictures' noise
};

// One exposure and one picture a camera, as SceneRenderer::render. Called in one thread, ahead of
// the barrier; every picture is of the setup's size.
using PictureSource = std::function<void(std::span<const Exposure>, std::vector<GreyImage>&)>;

// Listens from open(); the frames start with start(). Every camera exposes at the same barrier; a
// camera that has not finished sending the frame before leaves the new one out. What the guest sets
// as exposure and gain acts on the picture, from the next but one on. The barriers come at the
// frame rate as long as a camera streams; otherwise the scene's time stands still: barrier k is of
// the time k / frame_rate_hz. An instant at which the pictures are not ready has no barrier, and is
// counted.
class UsbCameraBank {
 public:
  // An error names the folder, the socket or the value that cannot be.
  static Result<std::unique_ptr<UsbCameraBank>> open(const UsbCameraSetup& setup,
                                                     PictureSource pictures);
  ~UsbCameraBank();
  UsbCameraBank(const UsbCameraBank&) = delete;
  UsbCameraBank& operator=(const UsbCameraBank&) = delete;

  void start();
  void stop();

  // The guest sees it soon after. A camera that was plugged in again is as new.
  void unplug(std::size_t camera);
  void plug_in(std::size_t camera);

  // From any thread.
  std::vector<Barrier> barriers() const;  // so far
  std::uint64_t late_barriers() const;    // instants without one, as the pictures were not ready
  std::uint64_t frames_sent(std::size_t camera) const;
  std::uint64_t frames_skipped(std::size_t camera) const;  // the one before was still on its way
  bool streaming(std::size_t camera) const;
  hal::ExposureSettings exposure(std::size_t camera) const;  // as the guest set it

 private:
  class Bank;
  explicit UsbCameraBank(std::unique_ptr<Bank> bank);
  std::unique_ptr<Bank> bank_;
};

}  // namespace dottrack::host_sim
