#include "app/config/can_reader.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace dottrack::config {
namespace {

constexpr IntegerRule kBaseId{0, protocol::kLastBaseId,
                              "a whole number from 0 to 0x7C0, with extended = true to 0x1FFFFFC0"};
constexpr IntegerRule kExtendedBaseId{0, protocol::kLastExtendedBaseId,
                                      "a whole number from 0 to 0x1FFFFFC0"};
constexpr IntegerRule kBitRate{10'000, 1'000'000,
                               "a whole number of bits a second from 10000 to 1000000"};
constexpr IntegerRule kDataBitRate{
    10'000, 8'000'000, "a whole number of bits a second, not below bit_rate and up to 8000000"};
constexpr NumberRule kMaxLoad{0.0, 1.0, "a share of the bus above 0 and up to 1"};
constexpr IntegerRule kPoseEvery{1, 255, "a whole number of ticks from 1 to 255"};
constexpr IntegerRule kEvery{0, 255, "a whole number of groups from 1 to 255, or 0 for never"};
constexpr int kCounterPeriod = 16;  // of the counter in every frame, four bits of the group's

static_assert(protocol::kLastBaseId == 0x7C0 && protocol::kLastExtendedBaseId == 0x1FFF'FFC0);

std::uint32_t read_bits(TableReader& reader, std::string_view key, std::uint32_t fallback,
                        const IntegerRule& rule) {
  return static_cast<std::uint32_t>(reader.integer(key, static_cast<int>(fallback), rule));
}

void read_addressing(TableReader& reader, protocol::Addressing& addressing) {
  addressing.extended = reader.boolean("extended", addressing.extended);
  addressing.fd = reader.boolean("fd", addressing.fd);
  addressing.base_id = read_bits(reader, "base_id", addressing.base_id,
                                 addressing.extended ? kExtendedBaseId : kBaseId);
}

// Without fd there is no second rate; with it the default may lie below bit_rate for no rate that
// is allowed.
void read_bit_rates(TableReader& reader, bool fd, protocol::BitRates& rates) {
  rates.arbitration = read_bits(reader, "bit_rate", rates.arbitration, kBitRate);
  if (!fd && reader.has("data_bit_rate")) {
    reader.complain("data_bit_rate", "without effect", "it with fd = true only");
  }
  rates.data = read_bits(reader, "data_bit_rate", rates.data, kDataBitRate);
  if (rates.data < rates.arbitration) {
    reader.complain("data_bit_rate", std::to_string(rates.data), kDataBitRate.expected);
  }
}

// A message of every 16th group would carry the same counter each time: its receiver could not tell
// it from one repeated.
unsigned read_every(TableReader& reader, std::string_view key, unsigned fallback) {
  const int every = reader.integer(key, static_cast<int>(fallback), kEvery);
  if (every != 0 && every % kCounterPeriod == 0) {
    reader.complain(key,
                    fmt::format("{}, at which this message's 4-bit counter stands still", every),
                    "no multiple of 16");
  }
  return static_cast<unsigned>(every);
}

void read_rates(TableReader& reader, bool fd, protocol::Rates& rates) {
  rates.pose_every = static_cast<unsigned>(
      reader.integer("pose_every", static_cast<int>(rates.pose_every), kPoseEvery));
  if (fd && reader.has("covariance_every")) {
    reader.complain("covariance_every", "without effect",
                    "it without fd only: the FD frame has the covariance every time");
  }
  rates.covariance_every = read_every(reader, "covariance_every", rates.covariance_every);
  rates.motion_every = read_every(reader, "motion_every", rates.motion_every);
  rates.cameras_every = read_every(reader, "cameras_every", rates.cameras_every);
  rates.dots_every = read_every(reader, "dots_every", rates.dots_every);
  rates.identity_every = read_every(reader, "identity_every", rates.identity_every);
  rates.light_every = static_cast<unsigned>(
      reader.integer("light_every", static_cast<int>(rates.light_every), kEvery));
}

protocol::PoseChoice read_pose_choice(TableReader& reader) {
  const std::string word = reader.text("pose", "measured");
  if (word == "filtered") return protocol::PoseChoice::filtered;
  if (word == "predicted") return protocol::PoseChoice::predicted;
  if (word != "measured") {
    reader.complain("pose", in_quotes(word), "\"measured\", \"filtered\" or \"predicted\"");
  }
  return protocol::PoseChoice::measured;
}

}  // namespace

void read_can(Complaint& complaint, const toml::table& table, CanConfig& can) {
  TableReader reader(complaint, table, "[can]",
                     {"interface", "base_id", "extended", "fd", "bit_rate", "data_bit_rate",
                      "max_load", "pose_every", "covariance_every", "motion_every", "cameras_every",
                      "dots_every", "identity_every", "light_every", "commands", "pose"});
  can.interface = reader.text("interface", can.interface);
  if (can.interface.empty() || can.interface.size() > 15) {
    reader.complain("interface", in_quotes(can.interface), "a network interface such as can0");
  }
  read_addressing(reader, can.addressing);
  read_bit_rates(reader, can.addressing.fd, can.bit_rates);
  can.max_load = reader.number("max_load", can.max_load, kMaxLoad);
  read_rates(reader, can.addressing.fd, can.rates);
  can.pose = read_pose_choice(reader);
  can.commands = reader.boolean("commands", can.commands);
}

}  // namespace dottrack::config
