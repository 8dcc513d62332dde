#pragma once
// How much of a CAN bus the unit's messages take, at worst.

#include <array>
#include <cstddef>
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
  unsigned light_every = 0;  // the next camera's, one after another

  bool operator==(const Rates&) const = default;
};

struct BitRates {
  std::uint32_t arbitration = 500'000;  // bits per second; of a classic bus the only one
  std::uint32_t data = 2'000'000;       // of the data phase of an FD frame

  bool operator==(const BitRates&) const = default;
};

// How long a frame occupies the bus with as many stuff bits as it can have, the interframe space
// included (ISO 11898-1:2015). `bytes`: 0 to 8, FD up to 64; an FD frame of a length that does not
// exist counts as the next longer one. An FD frame switches its bit rate.
struct FrameShape {
  bool extended = false;
  bool fd = false;
  unsigned bytes = 8;
};
unsigned classic_frame_bits(const FrameShape& shape);
double frame_time_s(const FrameShape& shape, const BitRates& bit_rates);

// One kind of message: how many frames it has, after how many groups it goes out again (0: never;
// the pose is in every group), and how long its frames take together.
struct PartLoad {
  unsigned frames = 0;
  unsigned every = 0;
  double time_s = 0.0;
};

// In the order of Rates: pose, covariance, motion, cameras, dots, identity, light. In FD the
// covariance is part of the pose. Of a target with `dots` dots.
inline constexpr std::size_t kParts = 7;
std::array<PartLoad, kParts> part_loads(const Addressing& addressing, const Rates& rates,
                                        const BitRates& bit_rates, unsigned dots);

// Groups out of turn, because the state changed, and replies to commands come on top.
struct BusLoad {
  double average = 0.0;      // share of the bus, over a long time
  Duration fullest_group{};  // when every message falls together
  unsigned fullest_frames = 0;
};

BusLoad bus_load(const Addressing& addressing, const Rates& rates, const BitRates& bit_rates,
                 unsigned dots, Duration tick_period);

}  // namespace dottrack::protocol
