#pragma once
// The virtual board with all that hangs on it: cameras, CAN listener, GPIO lines, journal, shell.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"
#include "host_sim/usb_cameras/usb_camera_bank.h"
#include "tests/board/harness/emulator.h"
#include "tests/board/harness/gpio_bench.h"
#include "tests/board/harness/guest_shell.h"
#include "tests/board/harness/lighting.h"
#include "tests/board/harness/pose_log.h"
#include "tests/board/harness/time_map.h"

namespace dottrack::board {

inline constexpr const char* kService = "dottrackd.service";

class Board {
 public:
  // Renders the hall, opens the cameras and switches the board on. `scene` must outlive this.
  static Result<std::unique_ptr<Board>> power_on(const host_sim::Scene& scene,
                                                 const EmulatorSetup& setup);
  ~Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  // Once after power-on and once after every reset: waits for the guest's shell, then sets up what
  // a real board has soldered on and this one simulates (GPIO chips), and starts the observers.
  Result<void> set_up_guest();
  // To be told as soon as a reset is seen, before set_up_guest().
  void note_reset();

  // Asks the guest for its time, so that stamps of this boot can be told on this machine's clock.
  Result<void> ask_time();
  // A stamp of a boot on this machine's clock.
  Time to_host(unsigned boot, Time guest) const { return times_.at(boot).to_host(guest); }
  const TimeMap& time_map() const { return times_.back(); }

  // A property of the unit's service, as `systemctl show` gives it.
  Result<std::string> service(const std::string& property);

  Time powered_on() const { return powered_on_; }
  const host_sim::Scene& scene() const { return scene_; }
  host_sim::UsbCameraBank& cameras() { return *cameras_; }
  Lighting& lighting() { return lighting_; }
  Emulator& emulator() { return *emulator_; }
  GuestShell& shell() { return *shell_; }
  const PoseLog& poses() const { return poses_; }
  const GpioBench& gpio() const { return gpio_; }
  const LineLog& journal() const { return *journal_; }

 private:
  Board(const host_sim::Scene& scene, const EmulatorSetup& setup);
  Result<void> open_cameras();
  Result<void> connect();
  Result<std::unique_ptr<LineLog>> log_of(const char* socket, LineLog::Listener listener = {});

  const host_sim::Scene& scene_;
  EmulatorSetup setup_;
  PoseLog poses_;
  GpioBench gpio_;
  Lighting lighting_;
  std::vector<TimeMap> times_;  // one a boot
  Time powered_on_{};
  std::size_t heard_before_ = 0;  // bytes from the shell before this boot
  std::unique_ptr<host_sim::UsbCameraBank> cameras_;
  std::unique_ptr<Emulator> emulator_;
  std::unique_ptr<LineLog> shell_line_;
  std::unique_ptr<LineLog> can_;
  std::unique_ptr<LineLog> gpio_trace_;
  std::unique_ptr<LineLog> journal_;
  std::unique_ptr<GuestShell> shell_;
};

}  // namespace dottrack::board
