#include <fmt/format.h>

#include "app/telemetry/pose_files.h"

namespace dottrack::telemetry {

std::string tum_line(Time stamp, const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  const std::int64_t ns = stamp.time_since_epoch().count();
  return fmt::format("{}.{:09} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", ns / 1000000000,
                     ns % 1000000000, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

void TumWriter::do_write(const CycleRecord& record) {
  if (!record.result.has_pose) return;
  file_.write(
      tum_line(record.stamp, record.result.pose.position_m, record.result.pose.orientation));
}

void FilteredTumWriter::do_write(const CycleRecord& record) {
  const core::FilteredPose& filtered = record.result.filtered;
  if (!filtered.known) return;
  file_.write(tum_line(record.stamp, filtered.pose.position_m, filtered.pose.orientation));
}

}  // namespace dottrack::telemetry
