#include "app/workstation/mavlink/mavlink_sender.h"

#include <utility>

#include "app/workstation/mavlink/pose_sequence.h"
#include "app/workstation/mavlink/udp_link.h"

namespace dottrack::workstation {

struct MavlinkSender::Link {
  UdpLink udp;
  PoseSequence poses;
  std::uint64_t sent = 0;
  std::uint64_t failed = 0;
};

Result<std::unique_ptr<MavlinkSender>> MavlinkSender::open(const std::string& host_and_port,
                                                           const MavlinkOptions& options) {
  auto udp = UdpLink::open(host_and_port);
  if (!udp) return tl::unexpected(udp.error());
  auto link = std::make_unique<Link>(Link{.udp = std::move(*udp), .poses = PoseSequence(options)});
  return std::unique_ptr<MavlinkSender>(new MavlinkSender(std::move(link)));
}

Result<std::unique_ptr<MavlinkSender>> MavlinkSender::open(const std::string& host_and_port) {
  return open(host_and_port, MavlinkOptions{});
}

MavlinkSender::MavlinkSender(std::unique_ptr<Link> link) : link_(std::move(link)) {}

MavlinkSender::~MavlinkSender() = default;

void MavlinkSender::send(const dottrack_pose& pose) {
  bool all_left = true;
  for (const MavlinkFrame& frame : link_->poses.frames_of(pose)) {
    all_left = link_->udp.send(frame.view()) && all_left;
  }
  if (can_be_handed_over(pose)) ++(all_left ? link_->sent : link_->failed);
}

std::uint64_t MavlinkSender::sent() const {
  return link_->sent;
}

std::uint64_t MavlinkSender::failed() const {
  return link_->failed;
}

}  // namespace dottrack::workstation
