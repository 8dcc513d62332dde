#include "drivers/libcamera/shared_manager.h"

#include <libcamera/version.h>

#include <cstring>
#include <mutex>

namespace dottrack::drivers {
namespace {

std::mutex guard;
SharedManager* the_manager = nullptr;
int users = 0;

}  // namespace

const bool SharedManager::kWears = LIBCAMERA_VERSION_MAJOR == 0 && LIBCAMERA_VERSION_MINOR < 4;

Result<std::shared_ptr<SharedManager>> SharedManager::use() {
  const std::lock_guard lock(guard);
  if (the_manager == nullptr) {
    std::unique_ptr<SharedManager> fresh(new SharedManager);
    if (const auto started = fresh->start(); !started) return tl::unexpected(started.error());
    the_manager = fresh.release();
  }
  ++users;
  return std::shared_ptr<SharedManager>(the_manager, &SharedManager::leave);
}

Result<void> SharedManager::start() {
  const int status = manager_.start();
  if (status < 0) return fail(std::string("libcamera does not start: ") + std::strerror(-status));
  manager_.cameraAdded.connect(this, &SharedManager::on_added);
  return {};
}

void SharedManager::leave(SharedManager* manager) {
  const std::lock_guard lock(guard);
  if (--users > 0) return;
  manager->manager_.stop();
  delete manager;
  the_manager = nullptr;
}

bool SharedManager::has_one_user() {
  const std::lock_guard lock(guard);
  return users == 1;
}

// On libcamera's thread.
void SharedManager::on_added(std::shared_ptr<libcamera::Camera> /*camera*/) {
  ++plugged_in_;
}

}  // namespace dottrack::drivers
