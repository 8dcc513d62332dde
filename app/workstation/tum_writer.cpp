#include <fmt/format.h>

#include <iterator>

#include "app/workstation/pose_files.h"

namespace dottrack::workstation {

void TumWriter::do_write(const telemetry::CycleRecord& record) {
  if (!record.result.has_pose) return;
  const std::int64_t ns = record.stamp.time_since_epoch().count();
  const Eigen::Vector3d& p = record.result.pose.position_m;
  const Eigen::Quaterniond& q = record.result.pose.orientation;
  line_.clear();
  fmt::format_to(std::back_inserter(line_),
                 "{}.{:09} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", ns / 1000000000,
                 ns % 1000000000, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  file_.write(line_);
}

}  // namespace dottrack::workstation
