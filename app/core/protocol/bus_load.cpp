#include "app/core/protocol/bus_load.h"

#include <algorithm>

namespace dottrack::protocol {
namespace {

// After five equal bits the sender puts in the opposite one, which may be the first of the next
// five: the first stuff bit takes five bits, each further one four.
constexpr unsigned stuff_bits(unsigned bits) {
  return (bits - 1) / 4;
}

// Start of frame 1, identifier 11, RTR 1, IDE 1, FDF 1, DLC 4, CRC 15; an extended identifier adds
// its 18 bits, SRR and a reserved bit. All of it and the data are stuffed.
constexpr unsigned kClassic = 34;
constexpr unsigned kClassicExtended = kClassic + 20;
// Not stuffed: CRC delimiter 1, ACK 1, ACK delimiter 1, end of frame 7, intermission 3.
constexpr unsigned kClassicEnd = 13;

// The arbitration rate is in force up to the sample point of BRS, the data rate from there to the
// sample point of the CRC delimiter. The two bits with a rate for each part of them count as long.
//
// Arbitration rate: start of frame 1, identifier 11, RRS 1, IDE 1, FDF 1, reserved 1, BRS 1; an
// extended identifier adds its 18 bits and SRR.
constexpr unsigned kFdHead = 17;
constexpr unsigned kFdHeadExtended = kFdHead + 19;
// Data rate: ESI 1, DLC 4, then the data.
constexpr unsigned kFdControl = 5;
// Arbitration rate again: CRC delimiter and ACK, to each of which a distant receiver may add a bit,
// ACK delimiter 1, end of frame 7, intermission 3.
constexpr unsigned kFdEnd = 15;

constexpr unsigned kStuffCount = 4;  // three bits and their parity
constexpr unsigned kShortCrc = 17;   // up to 16 bytes of data
constexpr unsigned kLongCrc = 21;
constexpr unsigned kShortCrcBytes = 16;

// Stuff count and CRC: a fixed stuff bit before the first bit and after each four that another one
// follows. CRC-17: 21 + 6 bits, CRC-21: 25 + 7.
constexpr unsigned checksum_bits(unsigned bytes) {
  const unsigned bits = kStuffCount + (bytes <= kShortCrcBytes ? kShortCrc : kLongCrc);
  return bits + 1 + (bits - 1) / 4;
}
static_assert(checksum_bits(16) == 27 && checksum_bits(20) == 32);

unsigned fd_length(unsigned bytes) {
  constexpr std::array<unsigned, 7> kLengths{12, 16, 20, 24, 32, 48, 64};
  if (bytes <= 8) return bytes;
  return *std::find_if(kLengths.begin(), kLengths.end() - 1,
                       [&](unsigned length) { return length >= bytes; });
}

// Stuff bits go by what is before them: one that the last bit before the CRC would ask for is the
// fixed one, and one that BRS asks for has the data rate already. So of both parts the last bit
// does not count, and with as many slow stuff bits as there can be the time is the longest.
double fd_frame_time_s(const FrameShape& shape, const BitRates& bit_rates) {
  const unsigned bytes = fd_length(shape.bytes);
  const unsigned head = shape.extended ? kFdHeadExtended : kFdHead;
  const unsigned body = kFdControl + 8 * bytes;
  const unsigned slow_stuff = stuff_bits(head - 1);
  const unsigned fast_stuff = stuff_bits(head + body - 1) - slow_stuff;
  const unsigned slow = head + slow_stuff + kFdEnd;
  const unsigned fast = body + fast_stuff + checksum_bits(bytes);
  return static_cast<double>(slow) / bit_rates.arbitration +
         static_cast<double>(fast) / bit_rates.data;
}

}  // namespace

unsigned classic_frame_bits(const FrameShape& shape) {
  const unsigned stuffed =
      (shape.extended ? kClassicExtended : kClassic) + 8 * std::min(shape.bytes, 8U);
  return stuffed + stuff_bits(stuffed) + kClassicEnd;
}

double frame_time_s(const FrameShape& shape, const BitRates& bit_rates) {
  if (shape.fd) return fd_frame_time_s(shape, bit_rates);
  return static_cast<double>(classic_frame_bits(shape)) / bit_rates.arbitration;
}

std::array<PartLoad, kParts> part_loads(const Addressing& addressing, const Rates& rates,
                                        const BitRates& bit_rates, unsigned dots) {
  const double frame_s = frame_time_s({.extended = addressing.extended}, bit_rates);
  const auto part = [&](unsigned frames, unsigned every) {
    return PartLoad{.frames = frames, .every = every, .time_s = frames * frame_s};
  };
  std::array<PartLoad, kParts> parts{part(6, 1),
                                     part(5, rates.covariance_every),
                                     part(2, rates.motion_every),
                                     part(1, rates.cameras_every),
                                     part(2 * dots, rates.dots_every),
                                     part(2, rates.identity_every),
                                     part(1, rates.light_every)};
  if (addressing.fd) {
    const FrameShape pose{.extended = addressing.extended, .fd = true, .bytes = 64};
    parts[0] = {.frames = 1, .every = 1, .time_s = frame_time_s(pose, bit_rates)};
    parts[1] = {};
  }
  return parts;
}

BusLoad bus_load(const Addressing& addressing, const Rates& rates, const BitRates& bit_rates,
                 unsigned dots, Duration tick_period) {
  double fullest_s = 0.0;
  double average_s = 0.0;  // a group
  BusLoad load;
  for (const PartLoad& part : part_loads(addressing, rates, bit_rates, dots)) {
    if (part.every == 0) continue;
    average_s += part.time_s / part.every;
    fullest_s += part.time_s;
    load.fullest_frames += part.frames;
  }
  load.average = average_s / (to_seconds(tick_period) * rates.pose_every);
  load.fullest_group = std::chrono::ceil<Duration>(std::chrono::duration<double>(fullest_s));
  return load;
}

}  // namespace dottrack::protocol
