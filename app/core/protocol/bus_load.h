#pragma once
// How much of a CAN bus the unit's messages take, at worst.

#include <cstdint>

#include "app/core/protocol/addressing.h"
#include "hal/base/time.h"

namespace dottrack::protocol {

// How often each message goes out. 0: never.
struct Rates {
  unsigned pose_every = 1;        // ticks a group
  unsigned covariance_every = 1;  // groups, as all below; in FD it is part of the pose
  unsigned motion_every = 1;
  unsigned cameras_every = 10;
  unsigned dots_every = 10;
  unsigned identity_every = 30;

  bool operator==(const Rates&) const = default;
};

struct BitRates {
  std::uint32_t arbitration = 500'000;  // bits per second; of a classic bus the only one
  std::uint32_t data = 2'000'000;       // of the data phase of an FD frame

  bool operator==(const BitRates&) const = default;
};

// How long a frame occupies the bus with as many stuff bits as it can have, the interframe space
// included (ISO 11898-1:2015). `bytes`: 0 to 8, FD up to 64.
struct FrameShape {
  bool extended = false;
  bool fd = false;
  unsigned bytes = 8;
};
unsigned classic_frame_bits(const FrameShape& shape);
double frame_time_s(const FrameShape& shape, const BitRates& bit_rates);

struct BusLoad {
  double average = 0.0;      // share of the bus, over a long time
  Duration fullest_group{};  // when every message falls together
  unsigned fullest_frames = 0;
};

BusLoad bus_load(const Addressing& addressing, const Rates& rates, const BitRates& bit_rates,
                 unsigned dots, Duration tick_period);

}  // namespace dottrack::protocol
