#pragma once
// Hands poses over to an autopilot (PX4, ArduPilot) or whatever else reads MAVLink 2, over UDP.
//
// Each valid pose of known age becomes VISION_POSITION_ESTIMATE (#102) and ODOMETRY (#331), one
// datagram each, and once a second of the poses' own time a HEARTBEAT (#0) goes ahead of them.
// Frames: the local north-east-down frame is made of dottrack's world by north = y, east = x, down
// = -z; the body is forward-right-down. Time: the middle of the exposure on the clock of
// dottrack_pose::arrival_us. A network that takes nothing never stops the caller: what it refuses
// is counted and forgotten.

#include <cstdint>
#include <memory>
#include <string>

#include "app/core/protocol/receiver/dottrack_receiver.h"
#include "hal/base/result.h"

namespace dottrack::workstation {

struct MavlinkOptions {
  std::uint8_t system = 1;       // that of the autopilot that takes the poses
  std::uint8_t component = 197;  // MAV_COMP_ID_VISUAL_INERTIAL_ODOMETRY
  // Either message is a whole pose. An autopilot that fuses both should get one.
  bool vision_position_estimate = true;
  bool odometry = true;
};

class MavlinkSender {
 public:
  // "HOST:PORT", HOST being a name, an IPv4 address or an IPv6 address in brackets:
  // "192.168.1.10:14550", "[::1]:14550". One line says what is wrong with it.
  static Result<std::unique_ptr<MavlinkSender>> open(const std::string& host_and_port,
                                                     const MavlinkOptions& options);
  static Result<std::unique_ptr<MavlinkSender>> open(const std::string& host_and_port);

  MavlinkSender(const MavlinkSender&) = delete;
  MavlinkSender& operator=(const MavlinkSender&) = delete;
  MavlinkSender(MavlinkSender&&) = delete;
  MavlinkSender& operator=(MavlinkSender&&) = delete;
  ~MavlinkSender();

  // Takes each fresh group, with a pose or without: the heartbeat goes on while there is none.
  void send(const dottrack_pose& pose);

  std::uint64_t sent() const;    // poses of which every message left
  std::uint64_t failed() const;  // poses of which a message did not

 private:
  struct Link;
  explicit MavlinkSender(std::unique_ptr<Link> link);

  std::unique_ptr<Link> link_;
};

}  // namespace dottrack::workstation
