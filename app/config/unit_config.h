#pragma once
// What a rig file says of the unit that it is flashed onto: devices, wiring, priorities. A
// workstation reads and checks it, and uses [can] alone: to log what the unit would send.

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/core/protocol/broadcast_settings.h"
#include "app/core/protocol/bus_load.h"
#include "hal/base/camera_set.h"
#include "hal/base/time.h"

namespace dottrack::config {

// One line of a GPIO chip, which goes by label, name or path.
struct LineConfig {
  std::string chip;
  unsigned line = 0;
  bool active_low = false;

  bool operator==(const LineConfig&) const = default;
};

// A P-iris: a stepper that turns the blades between two end stops.
struct IrisConfig {
  std::string chip;
  unsigned step_line = 0;
  unsigned direction_line = 0;
  std::optional<unsigned> enable_line;
  std::optional<unsigned> auto_line;      // active: the unit overrides the lens's auto-iris
  std::optional<unsigned> end_stop_line;  // input, active at the closed end; without it the motor
                                          // is driven against the stop for its whole travel
  int travel_steps = 0;                   // from closed to fully open
  double steps_per_s = 100.0;
  int backlash_steps = 0;
  std::array<double, 2> limits{0.0, 1.0};  // openings it may be sent to
  double opening = 1.0;                    // where it goes at start

  bool operator==(const IrisConfig&) const = default;
};

struct CameraUnitConfig {
  std::string device;  // libcamera id; empty off the board
  double exposure_ms = 4.0;
  double gain = 1.0;
  double stamp_offset_ms = 0.0;  // added to what the driver takes for the middle of the exposure
  std::optional<IrisConfig> iris;

  bool operator==(const CameraUnitConfig&) const = default;
};

struct TriggerConfig {
  LineConfig line;
  bool cameras_follow = true;  // false: the line pulses, but the cameras run freely

  bool operator==(const TriggerConfig&) const = default;
};

struct CanConfig {
  std::string interface = "can0";
  protocol::Addressing addressing;  // base_id, extended, fd
  protocol::BitRates bit_rates;     // bit_rate, data_bit_rate
  double max_load = 0.7;            // share of the bus that the unit may take
  protocol::Rates rates;            // pose_every, covariance_every ...
  protocol::PoseChoice pose = protocol::PoseChoice::measured;
  bool commands = false;  // listen to commands

  bool operator==(const CanConfig&) const = default;
};

// Of light control: [light].
struct LightConfig {
  bool control = false;       // off: exposures, gains and lenses are left alone
  double target_part = 0.75;  // of full scale, for the brightest dot of a camera
  std::array<double, 2> exposure_ms{0.05, 10.0};
  std::array<double, 2> gain{1.0, 8.0};
  int delay_ticks = 4;       // until a setting shows in a frame, at most
  double max_blur_px = 0.5;  // that a dot may move while it is exposed

  bool operator==(const LightConfig&) const = default;
};

struct LoopConfig {
  int priority = 80;       // SCHED_FIFO, 1 to 99
  std::optional<int> cpu;  // that the loop has for itself
  std::string watchdog;    // device; empty: only the service manager watches
  double watchdog_s = 10.0;

  bool operator==(const LoopConfig&) const = default;
};

struct RecordingConfig {
  std::filesystem::path folder;
  bool frames = false;         // the images too, as a replay reads them
  double min_free_mb = 200.0;  // of the disk that stay free

  bool operator==(const RecordingConfig&) const = default;
};

struct UnitConfig {
  std::array<CameraUnitConfig, kMaxCameras> cameras;  // in the rig's order
  CanConfig can;
  std::optional<TriggerConfig> trigger;  // absent: the cameras run freely
  std::optional<LineConfig> lamp;
  LightConfig light;
  LoopConfig loop;
  std::optional<RecordingConfig> recording;

  bool operator==(const UnitConfig&) const = default;
};

}  // namespace dottrack::config
