#pragma once
// What a unit keeps on disk of its run: poses and, where asked for, the frames they were made of.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/telemetry/frame_ring.h"
#include "app/telemetry/frame_writer.h"
#include "app/telemetry/pose_files.h"
#include "app/telemetry/recorder.h"

namespace dottrack::telemetry {

struct RecordingSettings {
  std::filesystem::path folder;
  bool frames = false;
  std::uint64_t min_free_bytes = 0;  // of the disk that stay free
  std::vector<std::string> cameras;
  std::size_t dots = 0;
};

// Bytes that are free where a folder is; nothing when that cannot be told.
using FreeSpace = std::function<std::optional<std::uint64_t>(const std::filesystem::path&)>;
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& folder);

// Writes FOLDER/run-000001/poses.tum, poses.csv and frames/, the next number at every start. When
// the disk is full or a file cannot be written, the run is closed as it is, what is not recorded is
// counted, and a new run begins as soon as there is room again. Outside the loop.
class Recording final : public RecordWriter {
 public:
  // `frames` may be null; it outlives this.
  Recording(RecordingSettings settings, FrameRing* frames, FreeSpace free_space = free_bytes);
  ~Recording() override;

  // After a round of records: writes the frames that wait and hands all files to the system.
  void settle();

  bool running() const { return run_ != nullptr; }
  std::uint64_t lost_ticks() const { return lost_ticks_; }    // records not written
  std::uint64_t lost_frames() const { return lost_frames_; }  // ticks of frames not written
  // Why nothing is recorded; empty while something is.
  const std::string& fault() const { return fault_; }

 private:
  struct Run;

  void do_write(const CycleRecord& record) override;
  void write_frames(const FrameCopy& copy);
  bool ready();
  Result<void> start();
  void stop(std::string why);
  std::optional<std::string> no_room() const;

  RecordingSettings settings_;
  FrameRing* frames_;
  FreeSpace free_space_;
  std::unique_ptr<Run> run_;
  std::uint64_t ticks_until_retry_ = 0;
  std::uint64_t lost_ticks_ = 0;
  std::uint64_t lost_frames_ = 0;
  std::string fault_;
};

}  // namespace dottrack::telemetry
