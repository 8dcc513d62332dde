#pragma once
// The frames that a run delivered, as files that a replay reads.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "host_sim/hal/sim_frame_grabber.h"

namespace dottrack::host_sim {

// folder/<camera>/<tick, six digits>.pgm and folder/times.csv, with when each frame was exposed and
// when it was there: a replay of it in virtual time is the run again.
class FrameRecorder {
 public:
  // `cameras`: names, in the grabber's order. Frames that an older recording left there go.
  static Result<std::unique_ptr<FrameRecorder>> open(const std::filesystem::path& folder,
                                                     std::vector<std::string> cameras);

  // After a tick: what the grabber delivered in it.
  Result<void> record(std::uint64_t tick, const SimFrameGrabber& grabber);

  Result<void> finish();

 private:
  FrameRecorder(std::filesystem::path folder, std::vector<std::string> cameras);

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  std::ofstream times_;
};

}  // namespace dottrack::host_sim
