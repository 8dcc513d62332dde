#pragma once
// The records of a run as text: poses.tum and filtered.tum for trajectory tools, poses.csv
// for everything else.
// docs/outputs.md describes the columns.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "app/telemetry/output_file.h"
#include "app/telemetry/recorder.h"

namespace dottrack::telemetry {

// `t x y z qx qy qz qw`, seconds and metres, nine decimals each, with a line's end.
std::string tum_line(Time stamp, const Eigen::Vector3d& position_m,
                     const Eigen::Quaterniond& orientation);

// One line a tick that has a pose.
class TumWriter final : public RecordWriter {
 public:
  explicit TumWriter(OutputFile& file) : file_(file) {}

 private:
  void do_write(const CycleRecord& record) override;

  OutputFile& file_;
};

// One line a tick whose pose the filter knows, coasting or not.
class FilteredTumWriter final : public RecordWriter {
 public:
  explicit FilteredTumWriter(OutputFile& file) : file_(file) {}

 private:
  void do_write(const CycleRecord& record) override;

  OutputFile& file_;
};

// One line a tick, with a header. Times of the machine are not in it: the same images give the same
// bytes.
class CsvWriter final : public RecordWriter {
 public:
  CsvWriter(OutputFile& file, std::vector<std::string> cameras, std::size_t dots);

 private:
  void do_write(const CycleRecord& record) override;

  OutputFile& file_;
  std::vector<std::string> cameras_;
  std::size_t dots_;
  std::string line_;
};

}  // namespace dottrack::telemetry
