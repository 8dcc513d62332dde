#pragma once
// All devices of a unit, opened as its rig file says.

#include <memory>

#include "app/config/rig_file.h"
#include "drivers/libcamera/libcamera_grabber.h"
#include "drivers/libgpiod/gpio_iris.h"
#include "drivers/libgpiod/gpio_output_line.h"
#include "drivers/socketcan/socket_can_bus.h"
#include "rtos_shim/clock.h"

namespace dottrack::firmware {

// Members are destroyed from the last to the first: the cameras stop before their trigger line
// goes.
struct Hardware {
  std::unique_ptr<drivers::GpioOutputLine> trigger;  // may be null
  std::unique_ptr<drivers::GpioOutputLine> lamp;     // may be null
  std::unique_ptr<drivers::SocketCanBus> can;
  std::unique_ptr<drivers::GpioIris> irises;
  std::unique_ptr<drivers::LibcameraGrabber> cameras;

  // An error names the device. A camera that is configured but not plugged in is none: it joins
  // when it comes, and until then the status names it.
  static Result<std::unique_ptr<Hardware>> open(const config::RigConfig& config,
                                                const rtos::Clock& clock);
};

// From one tick to the next.
Duration period_of(const config::RigConfig& config);

}  // namespace dottrack::firmware
