#pragma once
// The record of one tick: plain data of fixed size, written by the loop, read by the recorder.

#include <array>
#include <cstdint>

#include "app/core/exposure/camera_light.h"
#include "app/core/protocol/command.h"
#include "app/core/tick_result.h"
#include "hal/base/camera_set.h"
#include "hal/base/time.h"
#include "hal/can_bus.h"

namespace dottrack::telemetry {

// How long each stage of the loop took, by the stopwatch.
struct StageTimes {
  Duration capture{};
  Duration track{};  // identify, acquire or follow, locate
  Duration broadcast{};
  Duration expose{};
  Duration record{};  // of the tick before: it ends only after its record is gone

  Duration cycle() const { return capture + track + broadcast + expose + record; }
};

// What went wrong since the loop started.
struct CycleCounters {
  std::array<std::uint64_t, kMaxCameras> missing_frames{};  // ticks without a usable image
  std::uint64_t deadline_misses = 0;  // instants of the grid that no tick attended
  std::uint64_t messages_sent = 0;    // whole groups of pose frames
  std::uint64_t sends_without_room = 0;
  std::uint64_t sends_failed = 0;
  std::uint64_t records_dropped = 0;  // the recorder was too slow
  std::uint64_t frames_dropped = 0;   // so was who keeps the images
  protocol::CommandCounts commands;   // over CAN
};

struct CycleRecord {
  Time due{};    // the instant of the grid that the tick belongs to
  Time woke{};   // when the tick began
  Time stamp{};  // mid-exposure; without any frame, the instant itself
  Time sent{};   // when the last of the tick's CAN frames was handed over
  core::TickResult result;
  StageTimes stages;
  CycleCounters counters;
  CameraSet unhealthy_irises;
  std::array<exposure::CameraLight, kMaxCameras> light{};
  hal::CanState can_state = hal::CanState::active;
};

}  // namespace dottrack::telemetry
