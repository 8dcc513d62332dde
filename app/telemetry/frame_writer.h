#pragma once
// Frames as files that a replay reads: FOLDER/<camera>/<tick, six digits>.pgm and FOLDER/times.csv.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/telemetry/frame_ring.h"
#include "app/telemetry/output_file.h"

namespace dottrack::telemetry {

// Outside the loop. The first thing that cannot be written ends it; nothing written before is lost.
class FrameWriter {
 public:
  // Makes the folders. An error names what cannot be made.
  static Result<std::unique_ptr<FrameWriter>> open(const std::filesystem::path& folder,
                                                   std::vector<std::string> cameras);

  // `tick`: the number that the frames get, counted from 0 within this recording.
  Result<void> write(std::uint64_t tick, const FrameCopy& copy);

  Result<void> finish() { return times_.finish(); }

 private:
  FrameWriter(std::filesystem::path folder, std::vector<std::string> cameras, OutputFile times);

  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  OutputFile times_;
};

}  // namespace dottrack::telemetry
