#pragma once
// What is done beside the loop, at ordinary priority: the journal, the recording, the status, and
// telling the service manager that the loop turns.

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/firmware/unit.h"
#include "app/telemetry/recording.h"
#include "app/telemetry/unit_log.h"
#include "rtos_shim/posix_rt/posix_thread.h"
#include "rtos_shim/posix_rt/service_manager.h"

namespace dottrack::firmware {

class Housekeeping {
 public:
  // All outlive this. `also` may be null: it gets every record too.
  Housekeeping(Unit& unit, const rtos::ServiceManager& manager, const Degradation& degradation,
               ContinuityFile& locks, telemetry::RecordWriter* also);
  // Empties the ring, closes the recording.
  ~Housekeeping();

  Result<void> start();

 private:
  void run();
  void round();
  void report_recording();
  void report_heap();
  void report_losses();
  void keep_locks();
  std::string status() const;

  Unit& unit_;
  const rtos::ServiceManager& manager_;
  const Degradation& degradation_;
  ContinuityFile& locks_;
  telemetry::UnitLog log_;
  std::optional<telemetry::Recording> recording_;
  telemetry::Recorder recorder_;
  std::string told_recording_fault_;
  std::uint64_t told_heap_calls_ = 0;
  bool told_locks_fault_ = false;
  std::array<drivers::CameraHealth, kMaxCameras> told_cameras_{};
  drivers::SocketCanCounts told_can_{};
  std::uint64_t rounds_ = 0;
  std::uint64_t ticks_at_last_kick_ = 0;
  std::atomic<bool> ending_{false};
  rtos::PosixThread thread_;
};

}  // namespace dottrack::firmware
