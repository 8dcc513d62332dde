// [vehicle], and how long tracking coasts.

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::replaced;
using test::RigFolder;

constexpr double kDegree = std::numbers::pi / 180.0;

const std::string kVehicle =
    "\n[vehicle]\n"                          // 30, 31
    "max_speed_m_s = 1.5\n"                  // 32
    "max_acceleration_m_s2 = 0.8\n"          // 33
    "max_turn_rate_deg_s = 90\n"             // 34
    "max_turn_acceleration_deg_s2 = 45.5\n"  // 35
    "\n[tracking]\n"                         // 36, 37
    "coast_ms = 250.5\n";                    // 38

// The good rig without its [tracking], then a vehicle: the lines stay.
std::string rig_with_vehicle() {
  const std::string blank =
      replaced(kGoodRig, "[tracking]\nmax_rms_residual_m = 0.01\nlost_after_ticks = 7\n", "\n\n\n");
  return blank + kVehicle;
}

RigConfig loaded(const std::string& text) {
  const RigFolder folder;
  folder.write("rig.toml", text);
  Result<RigConfig> config = load_rig(folder.rig());
  if (!config) throw std::runtime_error(config.error().message);
  return *config;
}

TEST(VehicleConfig, IsReadInDegreesAndMilliseconds) {
  const core::Rig rig = loaded(rig_with_vehicle()).rig;
  EXPECT_EQ(rig.vehicle.max_speed_m_s, 1.5);
  EXPECT_EQ(rig.vehicle.max_acceleration_m_s2, 0.8);
  EXPECT_NEAR(rig.vehicle.max_turn_rate_rad_s, 90.0 * kDegree, 1e-15);
  EXPECT_NEAR(rig.vehicle.max_turn_acceleration_rad_s2, 45.5 * kDegree, 1e-15);
  EXPECT_EQ(rig.limits.coast, std::chrono::microseconds(250'500));
}

TEST(VehicleConfig, HasDefaults) {
  const core::Rig rig = loaded(std::string(kGoodRig)).rig;
  EXPECT_EQ(rig.vehicle.max_speed_m_s, 2.0);
  EXPECT_EQ(rig.vehicle.max_acceleration_m_s2, 2.0);
  EXPECT_NEAR(rig.vehicle.max_turn_rate_rad_s, 120.0 * kDegree, 1e-15);
  EXPECT_NEAR(rig.vehicle.max_turn_acceleration_rad_s2, 240.0 * kDegree, 1e-15);
  EXPECT_EQ(rig.limits.coast, std::chrono::milliseconds(500));
}

TEST(VehicleConfig, CoastingMayBeTurnedOff) {
  const std::string text = replaced(rig_with_vehicle(), "coast_ms = 250.5", "coast_ms = 0");
  EXPECT_EQ(loaded(text).rig.limits.coast, Duration::zero());
}

TEST(VehicleConfig, ChangesTheNumberOfTheConfiguration) {
  const std::string text = rig_with_vehicle();
  const std::uint32_t hash = loaded(text).config_hash;
  EXPECT_EQ(loaded(text).config_hash, hash);
  EXPECT_NE(loaded(replaced(text, "max_speed_m_s = 1.5", "max_speed_m_s = 1.6")).config_hash, hash);
  EXPECT_NE(loaded(replaced(text, "coast_ms = 250.5", "coast_ms = 250")).config_hash, hash);
}

class VehicleConfigRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(VehicleConfigRefuses, WithOneLine) {
  const RigFolder folder;
  folder.write("rig.toml", replaced(rig_with_vehicle(), GetParam().from, GetParam().to));
  EXPECT_EQ(complaint_about(folder), GetParam().message);
}

const std::string kSpeedWords = "; expected a number of metres a second above 0 and up to 100";
const std::string kRateWords = "; expected a number of degrees a second above 0 and up to 3600";
const std::string kCoastWords = "; expected a number of milliseconds from 0 (never) to 10000";

INSTANTIATE_TEST_SUITE_P(
    Vehicle, VehicleConfigRefuses,
    testing::Values(
        Mistake{"UnknownKey", "max_speed_m_s", "max_speed",
                "rig.toml:32: unknown key \"max_speed\" in [vehicle]; expected one of "
                "max_speed_m_s, max_acceleration_m_s2, max_turn_rate_deg_s, "
                "max_turn_acceleration_deg_s2"},
        Mistake{"NoTable", "[vehicle]\n", "[[vehicle]]\n",
                "rig.toml:31: vehicle is a list of tables; expected a table [vehicle]"},
        Mistake{"SpeedZero", "1.5", "0", "rig.toml:32: max_speed_m_s is 0" + kSpeedWords},
        Mistake{"SpeedNegative", "1.5", "-1", "rig.toml:32: max_speed_m_s is -1" + kSpeedWords},
        Mistake{"SpeedInMillimetres", "1.5", "1500",
                "rig.toml:32: max_speed_m_s is 1500" + kSpeedWords},
        Mistake{"SpeedNaN", "1.5", "nan", "rig.toml:32: max_speed_m_s is nan" + kSpeedWords},
        Mistake{"AccelerationZero", "0.8", "0.0",
                "rig.toml:33: max_acceleration_m_s2 is 0; expected a number of metres a second "
                "squared above 0 and up to 1000"},
        Mistake{"TurnRateText", "90", "\"90\"",
                "rig.toml:34: max_turn_rate_deg_s is a text" + kRateWords},
        Mistake{"TurnRateTooHigh", "90", "3601",
                "rig.toml:34: max_turn_rate_deg_s is 3601" + kRateWords},
        Mistake{"TurnAccelerationInfinite", "45.5", "inf",
                "rig.toml:35: max_turn_acceleration_deg_s2 is inf; expected a number of degrees a "
                "second squared above 0 and up to 36000"},
        Mistake{"CoastNegative", "250.5", "-1", "rig.toml:38: coast_ms is -1" + kCoastWords},
        Mistake{"CoastTooLong", "250.5", "10001", "rig.toml:38: coast_ms is 10001" + kCoastWords},
        Mistake{"CoastText", "250.5", "\"never\"",
                "rig.toml:38: coast_ms is a text" + kCoastWords}),
    name_of);

}  // namespace
}  // namespace dottrack::config
