#include "host_sim/usb_cameras/picture_worker.h"

#include <utility>

namespace dottrack::host_sim {

PictureWorker::PictureWorker(PictureSource source)
    : source_(std::move(source)), thread_([this] { work(); }) {}

PictureWorker::~PictureWorker() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void PictureWorker::ask(std::vector<Exposure> exposures) {
  {
    const std::scoped_lock lock(mutex_);
    order_ = std::move(exposures);
    ordered_ = true;
  }
  changed_.notify_one();
}

bool PictureWorker::ready() const {
  const std::scoped_lock lock(mutex_);
  return done_ != nullptr;
}

Pictures PictureWorker::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(done_, nullptr);
}

void PictureWorker::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ordered_ || ending_; });
    if (ending_) return;
    ordered_ = false;
    const std::vector<Exposure> order = std::move(order_);
    lock.unlock();
    auto pictures = std::make_shared<std::vector<GreyImage>>();
    source_(order, *pictures);
    lock.lock();
    done_ = std::move(pictures);
  }
}

}  // namespace dottrack::host_sim
