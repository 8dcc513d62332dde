#include "app/config/can_load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <chrono>
#include <cmath>
#include <string_view>
#include <vector>

#include "app/config/complaint.h"

namespace dottrack::config {
namespace {

using protocol::Rates;

bool fits_on_average(const CanUse& use) {
  return bus_load(use).average <= use.can.max_load;
}

bool group_fits(const CanUse& use) {
  return to_seconds(bus_load(use).fullest_group) <= kLargestGroup / use.frame_rate_hz;
}

bool fits(const CanUse& use) {
  return fits_on_average(use) && group_fits(use);
}

struct Change {
  std::string_view key;
  unsigned Rates::*rate;
  unsigned every;
};

// In the order of what a vehicle misses least.
constexpr std::array<Change, 8> kChanges{{{"light_every", &Rates::light_every, 0},
                                          {"dots_every", &Rates::dots_every, 0},
                                          {"covariance_every", &Rates::covariance_every, 10},
                                          {"covariance_every", &Rates::covariance_every, 0},
                                          {"motion_every", &Rates::motion_every, 0},
                                          {"pose_every", &Rates::pose_every, 2},
                                          {"pose_every", &Rates::pose_every, 5},
                                          {"pose_every", &Rates::pose_every, 10}}};

// Makes a change that sends less; any other is none.
bool make(const Change& change, CanUse& use) {
  unsigned& every = use.can.rates.*change.rate;
  const bool less = every != 0 && (change.every == 0 || change.every > every);
  const bool has_effect = !use.can.addressing.fd || change.rate != &Rates::covariance_every;
  if (!less || !has_effect) return false;
  every = change.every;
  return true;
}

std::string words(const std::vector<Change>& changes) {
  std::vector<std::string> list;
  for (const Change& change : changes) {
    list.push_back(fmt::format("{} = {}", change.key, change.every));
  }
  return fmt::format("for instance with {}", fmt::join(list, ", "));
}

// One change if one is enough, else as many as it takes.
std::string remedy(const CanUse& use) {
  for (const Change& change : kChanges) {
    CanUse changed = use;
    if (make(change, changed) && fits(changed)) return words({change});
  }
  std::vector<Change> made;
  CanUse changed = use;
  for (const Change& change : kChanges) {
    if (!make(change, changed)) continue;
    if (!made.empty() && made.back().key == change.key) made.pop_back();
    made.push_back(change);
    if (fits(changed)) return words(made);
  }
  return "which takes a higher bit_rate or a lower frame_rate_hz";
}

std::string bit_rate_words(const CanConfig& can) {
  const std::string arbitration = shortest(can.bit_rates.arbitration / 1e3);
  if (!can.addressing.fd) return arbitration;
  return fmt::format("{}/{}", arbitration, shortest(can.bit_rates.data / 1e3));
}

}  // namespace

protocol::BusLoad bus_load(const CanUse& use) {
  const Duration tick_period(std::llround(1e9 / use.frame_rate_hz));
  return protocol::bus_load(use.can.addressing, use.can.rates, use.can.bit_rates, use.dots,
                            tick_period);
}

double tenths(double value) {
  constexpr double kNoise = 1e-5;  // durations are whole nanoseconds
  return std::ceil(value * 10.0 - kNoise) / 10.0;
}

std::string describe(const CanUse& use) {
  const protocol::BusLoad load = bus_load(use);
  return fmt::format("CAN: {:.1f} % of {} kbit/s, fullest group {} frames in {:.1f} ms",
                     tenths(load.average * 100.0), bit_rate_words(use.can), load.fullest_frames,
                     tenths(to_seconds(load.fullest_group) * 1e3));
}

std::optional<Overload> overload(const CanUse& use) {
  if (fits(use)) return std::nullopt;
  const std::string allowed =
      fits_on_average(use)
          ? fmt::format("{:.4g} ms at most, half a tick", kLargestGroup * 1e3 / use.frame_rate_hz)
          : fmt::format("{:.4g} % at most (max_load)", use.can.max_load * 100.0);
  return Overload{describe(use), allowed + ", " + remedy(use)};
}

}  // namespace dottrack::config
