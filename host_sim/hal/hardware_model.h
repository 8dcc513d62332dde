#pragma once
// How the simulated hardware behaves, and misbehaves.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/core/protocol/addressing.h"

namespace dottrack::host_sim {

struct GrabberModel {
  double latency_s = 0.010;  // from the end of the exposure to the frame in memory
  double jitter_s = 0.001;   // the latency is longer by up to this
  double drop_share = 0.0;   // of the frames that are lost on the way
};

enum class CameraFaultKind : std::uint8_t {
  dead,   // delivers nothing
  stuck,  // delivers the last picture again and again, with new sequence numbers
  torn,   // the lower part of a picture is still that of the tick before
  late,   // delivers after any deadline
};

struct CameraFault {
  std::size_t camera = 0;
  CameraFaultKind kind = CameraFaultKind::dead;
  double from_s = 0.0;
  double to_s = 0.0;
};

struct IrisModel {
  double opening = 1.0;  // at the start; share of the light of a fully open iris
  double min_opening = 0.05;
  double speed_per_s = 0.5;  // of the opening
  double backlash = 0.02;    // lost whenever the direction changes
  double drift_per_s = 0.0;  // the auto-iris wanders off: relative change of the light
  double wear_per_s = 0.0;   // so does the linkage, whoever is in charge, and nobody is told
};

enum class IrisFaultKind : std::uint8_t {
  stuck,  // the blades stay where they are; the motor knows nothing of it
  dead,   // neither moves nor answers
};

struct IrisFault {
  std::size_t camera = 0;
  IrisFaultKind kind = IrisFaultKind::stuck;
  double from_s = 0.0;
};

struct CanOutage {
  double from_s = 0.0;
  double to_s = 0.0;
};

struct CanModel {
  double bit_rate = 500000.0;
  double data_bit_rate = 2000000.0;  // of the data phase of FD frames
  double load = 0.0;                 // share of the bus that others use
  double error_share = 0.0;          // of the frames that are destroyed and sent again
  std::vector<CanOutage> bus_off = {};
  protocol::Addressing addressing = {};  // what the unit's rig file will say
};

}  // namespace dottrack::host_sim
