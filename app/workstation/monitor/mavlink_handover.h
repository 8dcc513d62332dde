#pragma once
// Fresh groups to an autopilot.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "app/workstation/mavlink/mavlink_sender.h"
#include "app/workstation/monitor/report.h"

namespace dottrack::monitor {

class MavlinkHandover final : public Writer {
 public:
  explicit MavlinkHandover(std::unique_ptr<workstation::MavlinkSender> sender)
      : sender_(std::move(sender)) {}

 private:
  void do_report(const Report& report, const Overview&) override {
    if (report.verdict == DOTTRACK_FRESH && report.pose != nullptr) sender_->send(*report.pose);
  }
  Result<void> do_finish(const Overview&) override {
    fmt::print(stderr, "dottrack: MAVLink: {} poses sent, {} not taken by the network\n",
               sender_->sent(), sender_->failed());
    return {};
  }

  std::unique_ptr<workstation::MavlinkSender> sender_;
};

}  // namespace dottrack::monitor
