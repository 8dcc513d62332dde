#pragma once
// The loop on recorded images: DIR/<camera>/<tick, six digits>.pgm in, poses and pictures out.

#include <filesystem>
#include <functional>
#include <string>

#include "app/workstation/run_summary.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct ReplayOptions {
  std::filesystem::path rig;
  std::filesystem::path frames;
  std::filesystem::path out;
  int repeat = 1;        // the last set of images is shown this many times
  bool pictures = true;  // overlay pictures of the first lock and of the last tick
  // Takes why ticks have no pose, for a person; empty function: nobody asks.
  std::function<void(const std::string&)> explain;
};

// Writes poses.tum, poses.csv, can.log, report.json and pictures/ into options.out. The same images
// give the same bytes, but for report.json, which tells how long things took. An error is wrong
// input: nothing was replayed. An image that cannot be read is one line on standard error and a
// camera that does not deliver.
Result<RunSummary> replay(const ReplayOptions& options);

}  // namespace dottrack::workstation
