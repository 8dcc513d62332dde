#pragma once
// The truth beside what the tracker reported: tick by tick, and what that comes to.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/core/tick_result.h"
#include "app/telemetry/output_file.h"
#include "app/telemetry/recorder.h"

namespace dottrack::workstation {

// A pose further off than one of these is a wrong lock, and so is any pose of a vehicle that is not
// there.
inline constexpr double kWrongLock_mm = 100.0;
inline constexpr double kWrongLock_deg = 5.0;

struct TruePose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();             // T_world_vehicle
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // body to world
};

// The vehicle at an instant; nothing while it is not there.
using Truth = std::function<std::optional<TruePose>(Time)>;

struct PoseError {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    // reported - true
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // that turns the true into the reported
  // Normalised squared error e' P^-1 e over the six degrees of freedom: 6 on the average when the
  // covariance P is true. NaN when P is no covariance.
  double nees = std::numeric_limits<double>::quiet_NaN();

  double position_mm() const { return 1000.0 * position_m.norm(); }
  double attitude_deg() const;
  bool wrong_lock() const;
};

PoseError error_of(const core::Pose& pose, const TruePose& truth);

struct TruthRow {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  bool has_pose = false;
  core::Reason reason = core::Reason::none;
  std::optional<TruePose> truth;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // reported
  std::optional<PoseError> error;                        // with both
  std::optional<PoseError> filtered_error;               // of the filter's pose, coasting or not
  bool coasting = false;
  int cameras_used = 0;
  int dots_used = 0;
  Duration cycle{};

  bool wrong_lock() const { return has_pose && (!error || error->wrong_lock()); }
};

struct Accuracy {
  std::uint64_t compared = 0;          // poses with a truth
  std::uint64_t wrong_lock_ticks = 0;  // poses without a truth among them
  double position_rms_mm = 0.0;
  double position_max_mm = 0.0;
  double attitude_rms_deg = 0.0;  // angle of the rotation between the two
  double attitude_max_deg = 0.0;
  double nees_mean = 0.0;
};

Accuracy accuracy_of(std::span<const TruthRow> rows);

// The filter's poses against the truth.
struct FilterAccuracy {
  std::uint64_t compared = 0;
  std::uint64_t coasting_ticks = 0;
  double position_rms_mm = 0.0;
  double position_max_mm = 0.0;
  double attitude_rms_deg = 0.0;
  double nees_mean = 0.0;
  // RMS over the ticks that coast.
  double coasting_rms_mm = 0.0;
};

FilterAccuracy filter_accuracy_of(std::span<const TruthRow> rows);

// Keeps a row a tick and writes the truth, `t x y z qx qy qz qw`, for the ticks that have one.
class TruthRecord final : public telemetry::RecordWriter {
 public:
  TruthRecord(telemetry::OutputFile& truth_tum, Truth truth)
      : file_(truth_tum), truth_(std::move(truth)) {}

  const std::vector<TruthRow>& rows() const { return rows_; }

 private:
  void do_write(const telemetry::CycleRecord& record) override;
  void write_line(Time stamp, const TruePose& truth);

  telemetry::OutputFile& file_;
  Truth truth_;
  std::vector<TruthRow> rows_;
};

}  // namespace dottrack::workstation
