#pragma once
// The thread that serves all cameras' sockets and releases the barriers.

#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "host_sim/usb_cameras/barrier_grid.h"
#include "host_sim/usb_cameras/camera_port.h"
#include "host_sim/usb_cameras/picture_worker.h"
#include "host_sim/usb_cameras/usb_camera_bank.h"
#include "rtos_shim/posix_rt/file_descriptor.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::host_sim {

class UsbCameraBank::Bank {
 public:
  using Ports = std::vector<std::unique_ptr<CameraPort>>;
  using Command = std::function<void(Bank&)>;

  struct Condition {
    std::uint64_t frames_sent = 0;
    std::uint64_t frames_skipped = 0;
    bool streaming = false;
    hal::ExposureSettings exposure;
  };

  static Result<std::unique_ptr<Bank>> open(const UsbCameraSetup& setup, PictureSource pictures,
                                            Ports ports);
  ~Bank();
  Bank(const Bank&) = delete;
  Bank& operator=(const Bank&) = delete;

  // From any thread. A command is done in the bank's own.
  void tell(Command command);
  std::vector<Barrier> barriers() const;
  std::uint64_t late_barriers() const;
  Condition condition(std::size_t camera) const;

  // In commands only.
  void start();
  void stop() { running_ = false; }
  CameraPort& port(std::size_t camera) { return *ports_.at(camera); }

 private:
  Bank(const UsbCameraSetup& setup, PictureSource pictures, Ports ports, rtos::FileDescriptor wake);
  void run();
  void wait();
  void obey();
  void keep_time();
  bool anyone_streams() const;
  std::vector<hal::ExposureSettings> settings() const;
  void order_pictures();
  void refresh_pictures();
  void release(Time now);
  void send();
  void publish();

  const UsbCameraSetup setup_;
  rtos::MonotonicClock clock_;
  Ports ports_;
  rtos::FileDescriptor wake_;
  BarrierGrid grid_;
  std::vector<hal::ExposureSettings> ordered_;  // of the pictures that come next
  bool running_ = false;
  bool ending_ = false;
  std::uint64_t next_barrier_ = 0;

  mutable std::mutex mutex_;  // of what follows
  std::vector<Command> commands_;
  std::vector<Barrier> barriers_;
  std::uint64_t late_ = 0;
  std::vector<Condition> conditions_;

  PictureWorker worker_;
  std::thread thread_;
};

}  // namespace dottrack::host_sim
