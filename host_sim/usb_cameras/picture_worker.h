#pragma once
// Renders ahead of time, in a thread of its own.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "host_sim/renderer/image_buffer.h"
#include "host_sim/renderer/sensor.h"
#include "host_sim/usb_cameras/usb_camera_bank.h"

namespace dottrack::host_sim {

// One picture a camera; nobody changes them any more.
using Pictures = std::shared_ptr<const std::vector<GreyImage>>;

// One order at a time: ask, then take until it is there, then ask again.
class PictureWorker {
 public:
  explicit PictureWorker(PictureSource source);
  // Waits for the rendering that is going on.
  ~PictureWorker();
  PictureWorker(const PictureWorker&) = delete;
  PictureWorker& operator=(const PictureWorker&) = delete;

  void ask(std::vector<Exposure> exposures);
  // Whether it is there; never waits.
  bool ready() const;
  // What ready() told of.
  Pictures take();

 private:
  void work();

  PictureSource source_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Exposure> order_;
  bool ordered_ = false;
  bool ending_ = false;
  Pictures done_;
  std::thread thread_;
};

}  // namespace dottrack::host_sim
