// [can] of a rig file: every key read, what has no effect refused, and what overloads the bus.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::replaced;
using test::RigFolder;

constexpr std::string_view kCan =
    "\n"                           // 30
    "[can]\n"                      // 31
    "interface = \"can1\"\n"       // 32
    "base_id = 0x18FF0000\n"       // 33
    "extended = true\n"            // 34
    "fd = true\n"                  // 35
    "bit_rate = 250_000\n"         // 36
    "data_bit_rate = 1_000_000\n"  // 37
    "max_load = 0.5\n"             // 38
    "pose_every = 2\n"             // 39
    "motion_every = 3\n"           // 40
    "cameras_every = 0\n"          // 41
    "dots_every = 15\n"            // 42
    "identity_every = 255\n"       // 43
    "commands = true\n"            // 44
    "light_every = 16\n";          // 45

std::string can_rig() {
  return std::string(kGoodRig) + std::string(kCan);
}

RigConfig load_or_fail(const RigFolder& folder, const std::string& text) {
  folder.write("rig.toml", text);
  Result<RigConfig> config = load_rig(folder.rig());
  if (!config) throw std::runtime_error(config.error().message);
  return std::move(*config);
}

TEST(CanConfigFile, ReadsEveryKey) {
  const CanConfig wanted{.interface = "can1",
                         .addressing = {.base_id = 0x18FF0000, .extended = true, .fd = true},
                         .bit_rates = {.arbitration = 250'000, .data = 1'000'000},
                         .max_load = 0.5,
                         .rates = {.pose_every = 2,
                                   .covariance_every = 1,
                                   .motion_every = 3,
                                   .cameras_every = 0,
                                   .dots_every = 15,
                                   .identity_every = 255,
                                   .light_every = 16},
                         .commands = true};
  EXPECT_EQ(load_or_fail(RigFolder(), can_rig()).unit.can, wanted);
}

TEST(CanConfigFile, ReadsTheRateOfTheCovariance) {
  const std::string text = std::string(kGoodRig) + "[can]\ncovariance_every = 7\n";
  EXPECT_EQ(load_or_fail(RigFolder(), text).unit.can.rates.covariance_every, 7U);
}

unsigned light_every(const std::string& more) {
  return load_or_fail(RigFolder(), std::string(kGoodRig) + more).unit.can.rates.light_every;
}

TEST(CanConfigFile, TheLightIsToldWhereItIsControlledUnlessTheFileSaysOtherwise) {
  const std::string controlled = "\n[light]\ncontrol = true\n";
  EXPECT_EQ(light_every(""), 0U);
  EXPECT_EQ(light_every("\n[light]\ncontrol = false\n"), 0U);
  EXPECT_EQ(light_every(controlled), 1U);
  EXPECT_EQ(light_every("\n[can]\ncommands = true\n" + controlled), 1U);
  EXPECT_EQ(light_every("\n[can]\nlight_every = 5\n" + controlled), 5U);
  EXPECT_EQ(light_every("\n[can]\nlight_every = 0\n" + controlled), 0U);
  EXPECT_EQ(light_every("\n[can]\nlight_every = 3\n"), 3U);
}

TEST(CanConfigFile, TakesTheLastIdentifiers) {
  const std::string start = std::string(kGoodRig) + "[can]\n";
  EXPECT_EQ(load_or_fail(RigFolder(), start + "base_id = 0x7C0\n").unit.can.addressing.base_id,
            0x7C0U);
  EXPECT_EQ(load_or_fail(RigFolder(), start + "base_id = 0x1FFFFFC0\nextended = true\n")
                .unit.can.addressing.base_id,
            0x1FFFFFC0U);
}

class CanConfigRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(CanConfigRefuses, WithOneLine) {
  const RigFolder folder;
  folder.write("rig.toml", replaced(can_rig(), GetParam().from, GetParam().to));
  EXPECT_EQ(complaint_about(folder), "rig.toml" + GetParam().message);
}

const std::string kEveryWords = "; expected a whole number of groups from 1 to 255, or 0 for never";
const std::string kStandsStill =
    ", at which this message's 4-bit counter stands still; expected no multiple of 16";
const std::string kDataWords =
    "; expected a whole number of bits a second, not below bit_rate and up to 8000000";

INSTANTIATE_TEST_SUITE_P(
    Mistakes, CanConfigRefuses,
    testing::Values(
        Mistake{
            "Key", "commands", "listen",
            ":44: unknown key \"listen\" in [can]; expected one of interface, base_id, "
            "extended, fd, bit_rate, data_bit_rate, max_load, pose_every, covariance_every, "
            "motion_every, cameras_every, dots_every, identity_every, light_every, commands, pose"},
        Mistake{"BaseIdWithoutExtended", "extended = true\n", "",
                ":33: base_id is 419364864; expected a whole number from 0 to 0x7C0, with extended "
                "= true to 0x1FFFFFC0"},
        Mistake{"BaseIdExtended", "0x18FF0000", "0x1FFFFFC1",
                ":33: base_id is 536870849; expected a whole number from 0 to 0x1FFFFFC0"},
        Mistake{"ExtendedIsNumber", "extended = true", "extended = 29",
                ":34: extended is a whole number; expected true or false"},
        Mistake{"BitRateInKilobits", "bit_rate = 250_000", "bit_rate = 250",
                ":36: bit_rate is 250; expected a whole number of bits a second from 10000 to "
                "1000000"},
        Mistake{"BitRateTooHigh", "bit_rate = 250_000", "bit_rate = 1_000_001",
                ":36: bit_rate is 1000001; expected a whole number of bits a second from 10000 to "
                "1000000"},
        Mistake{"DataBitRateBelow", "data_bit_rate = 1_000_000", "data_bit_rate = 249_999",
                ":37: data_bit_rate is 249999" + kDataWords},
        Mistake{"DataBitRateTooHigh", "data_bit_rate = 1_000_000", "data_bit_rate = 8_000_001",
                ":37: data_bit_rate is 8000001" + kDataWords},
        Mistake{"DataBitRateWithoutFd", "fd = true", "fd = false",
                ":37: data_bit_rate is without effect; expected it with fd = true only"},
        Mistake{"MaxLoadZero", "max_load = 0.5", "max_load = 0",
                ":38: max_load is 0; expected a share of the bus above 0 and up to 1"},
        Mistake{"MaxLoadInPercent", "max_load = 0.5", "max_load = 50",
                ":38: max_load is 50; expected a share of the bus above 0 and up to 1"},
        Mistake{"PoseNever", "pose_every = 2", "pose_every = 0",
                ":39: pose_every is 0; expected a whole number of ticks from 1 to 255"},
        Mistake{"CovarianceInFd", "pose_every = 2", "covariance_every = 1",
                ":39: covariance_every is without effect; expected it without fd only: the FD "
                "frame has the covariance every time"},
        Mistake{"MotionNegative", "motion_every = 3", "motion_every = -1",
                ":40: motion_every is -1" + kEveryWords},
        Mistake{"DotsEvery16", "dots_every = 15", "dots_every = 16",
                ":42: dots_every is 16" + kStandsStill},
        Mistake{"IdentityEvery240", "identity_every = 255", "identity_every = 240",
                ":43: identity_every is 240" + kStandsStill},
        Mistake{"LightTooSeldom", "light_every = 16", "light_every = 256",
                ":45: light_every is 256" + kEveryWords},
        Mistake{"IdentityTooSeldom", "identity_every = 255", "identity_every = 256",
                ":43: identity_every is 256" + kEveryWords}),
    name_of);

// Three dots, 25 ticks a second: 13 frames in every group, 22 in the fullest.
struct Load {
  std::string name;
  std::string can;  // lines under [can]
  std::string message;
};

void PrintTo(const Load& load, std::ostream* out) {
  *out << load.name;
}

class CanConfigRefusesOverload : public testing::TestWithParam<Load> {};

TEST_P(CanConfigRefusesOverload, WithOneLine) {
  const RigFolder folder;
  folder.write("rig.toml", std::string(kGoodRig) + "\n[can]\n" + GetParam().can);
  EXPECT_EQ(complaint_about(folder), GetParam().message);
}

// 22 frames of 135 bits at 125 kbit/s are 23.76 ms, and half a tick is 20 ms.
INSTANTIATE_TEST_SUITE_P(
    Loads, CanConfigRefusesOverload,
    testing::Values(
        Load{"FullestGroup", "bit_rate = 125_000\n",
             "rig.toml:31: CAN: 37.2 % of 125 kbit/s, fullest group 22 frames in 23.8 ms; expected "
             "20 ms at most, half a tick, for instance with dots_every = 0"},
        Load{"Average", "max_load = 0.09\n",
             "rig.toml:31: CAN: 9.3 % of 500 kbit/s, fullest group 22 frames in 6.0 ms; expected 9 "
             "% at most (max_load), for instance with dots_every = 0"},
        Load{"CovarianceIsEnough", "max_load = 0.07\ndots_every = 0\n",
             "rig.toml:31: CAN: 8.9 % of 500 kbit/s, fullest group 16 frames in 4.4 ms; expected 7 "
             "% at most (max_load), for instance with covariance_every = 10"},
        Load{"NoChangeIsEnough", "bit_rate = 50_000\n",
             "rig.toml:31: CAN: 93.0 % of 50 kbit/s, fullest group 22 frames in 59.4 ms; expected "
             "70 % at most (max_load), which takes a higher bit_rate or a lower frame_rate_hz"},
        Load{"SeveralChanges", "bit_rate = 80_000\n",
             "rig.toml:31: CAN: 58.1 % of 80 kbit/s, fullest group 22 frames in 37.2 ms; expected "
             "20 ms at most, half a tick, for instance with dots_every = 0, covariance_every = 0"},
        Load{"Fd", "fd = true\nmax_load = 0.001\n",
             "rig.toml:31: CAN: 2.9 % of 500/2000 kbit/s, fullest group 12 frames in 3.4 ms; "
             "expected 0.1 % at most (max_load), which takes a higher bit_rate or a lower "
             "frame_rate_hz"}),
    [](const auto& made) { return made.param.name; });

std::string at(std::string_view frame_rate_hz) {
  return replaced(kGoodRig, "25.0", frame_rate_hz);
}

TEST(CanConfigWithoutCan, HasTheDefaultsWhichMayBeTooMuch) {
  const RigFolder folder;
  folder.write("rig.toml", at("200"));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:3: CAN: 74.4 % of 500 kbit/s, fullest group 22 frames in 6.0 ms (the "
            "defaults of [can], at frame_rate_hz = 200); expected 70 % at most (max_load), for "
            "instance with dots_every = 0, covariance_every = 0, motion_every = 0");
}

std::string target_of(unsigned dots) {
  std::string text = "dot,x_m,y_m,z_m,diameter_m\n";
  for (unsigned i = 0; i < dots; ++i) {
    text += std::to_string(i) + "," + std::to_string(i) + "," + std::to_string(i * i % 17) +
            ",0.5,0.1\n";
  }
  return text;
}

TEST(CanConfigWithoutCan, AllowsAnyTargetAt30Hz) {
  const RigFolder folder;
  folder.write("target.csv", target_of(16));
  const RigConfig config = load_or_fail(folder, at("30"));
  EXPECT_EQ(describe(can_use(config)),
            "CAN: 13.3 % of 500 kbit/s, fullest group 48 frames in 13.0 ms");
  EXPECT_FALSE(overload(can_use(config)));
}

// What --check does with the rate that an interface has.
TEST(CanLoad, AtTheRateOfAnotherInterface) {
  CanUse use = can_use(load_or_fail(RigFolder(), at("30")));
  EXPECT_FALSE(overload(use));
  use.can.bit_rates.arbitration = 50'000;
  const auto too_much = overload(use);
  ASSERT_TRUE(too_much);
  EXPECT_EQ(too_much->what, describe(use));
}

}  // namespace
}  // namespace dottrack::config
