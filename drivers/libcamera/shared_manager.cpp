#include "drivers/libcamera/shared_manager.h"

#include <cstring>
#include <mutex>

namespace dottrack::drivers {
namespace {

using libcamera::CameraManager;

std::mutex guard;
std::unique_ptr<CameraManager> the_manager;
int users = 0;

void leave(CameraManager* /*the_one*/) {
  const std::lock_guard lock(guard);
  if (--users > 0) return;
  the_manager->stop();
  the_manager.reset();
}

}  // namespace

Result<std::shared_ptr<CameraManager>> shared_manager() {
  const std::lock_guard lock(guard);
  if (!the_manager) {
    auto fresh = std::make_unique<CameraManager>();
    const int status = fresh->start();
    if (status < 0) {
      return fail(std::string("libcamera does not start: ") + std::strerror(-status));
    }
    the_manager = std::move(fresh);
  }
  ++users;
  return std::shared_ptr<CameraManager>(the_manager.get(), &leave);
}

}  // namespace dottrack::drivers
