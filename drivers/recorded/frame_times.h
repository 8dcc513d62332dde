#pragma once
// times.csv: when the frames of a recording were exposed, and when they were there.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "hal/base/result.h"
#include "hal/base/time.h"

namespace dottrack::drivers {

struct FrameTimes {
  Time mid_exposure{};
  Time arrival{};
};

// A header `tick,camera,mid_exposure_ns,arrival_ns`, then one line a frame: whole nanoseconds on
// the recording loop's clock, an arrival not before its exposure, every frame once.
class FrameTimesTable {
 public:
  // An error is one line that names file, line and what was expected.
  static Result<FrameTimesTable> read(const std::filesystem::path& file);

  // Nothing for a frame that the file does not tell of.
  std::optional<FrameTimes> find(std::uint64_t tick, const std::string& camera) const;

 private:
  std::map<std::pair<std::uint64_t, std::string>, FrameTimes> times_;
};

}  // namespace dottrack::drivers
