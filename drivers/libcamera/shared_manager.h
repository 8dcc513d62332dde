#pragma once
// libcamera's camera manager, of which a process may have one.

#include <libcamera/camera_manager.h>

#include <atomic>
#include <memory>

#include "hal/base/result.h"

namespace dottrack::drivers {

class SharedManager {
 public:
  // Started; stops with its last user, who by then holds no camera. From any thread.
  static Result<std::shared_ptr<SharedManager>> use();

  libcamera::CameraManager& cameras() { return manager_; }

  // Before version 0.4 a manager searches all devices once more for every camera that was ever
  // plugged in, and that twice as often each time: 2^n searches. Whether so many were plugged in
  // since it started that it should be given up for a new one: soon, or at once.
  bool is_worn() const { return kWears && plugged_in_ >= 5; }
  bool is_worn_out() const { return kWears && plugged_in_ >= 8; }
  unsigned plugged_in() const { return plugged_in_; }
  // Whether to give it up would end it.
  static bool has_one_user();

 private:
  static const bool kWears;

  SharedManager() = default;
  Result<void> start();
  void on_added(std::shared_ptr<libcamera::Camera> camera);
  static void leave(SharedManager* manager);

  libcamera::CameraManager manager_;
  std::atomic<unsigned> plugged_in_{0};
};

}  // namespace dottrack::drivers
