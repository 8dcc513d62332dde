#include "app/config/vehicle_reader.h"

#include <numbers>

#include "app/config/table_reader.h"

namespace dottrack::config {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr NumberRule kSpeed{0.0, 100.0, "a number of metres a second above 0 and up to 100"};
constexpr NumberRule kAcceleration{0.0, 1000.0,
                                   "a number of metres a second squared above 0 and up to 1000"};
constexpr NumberRule kTurnRate{0.0, 3600.0, "a number of degrees a second above 0 and up to 3600"};
constexpr NumberRule kTurnAcceleration{
    0.0, 36'000.0, "a number of degrees a second squared above 0 and up to 36000"};

// The default is handed on as it is: to degrees and back would change its last bit.
double read_angle(TableReader& reader, std::string_view key, double fallback_rad,
                  const NumberRule& rule) {
  if (!reader.has(key)) return fallback_rad;
  return kDegree * reader.number(key, std::nullopt, rule);
}

}  // namespace

core::MotionLimits read_vehicle(Complaint& complaint, const toml::table& table) {
  TableReader reader(complaint, table, "[vehicle]",
                     {"max_speed_m_s", "max_acceleration_m_s2", "max_turn_rate_deg_s",
                      "max_turn_acceleration_deg_s2"});
  core::MotionLimits limits;
  limits.max_speed_m_s = reader.number("max_speed_m_s", limits.max_speed_m_s, kSpeed);
  limits.max_acceleration_m_s2 =
      reader.number("max_acceleration_m_s2", limits.max_acceleration_m_s2, kAcceleration);
  limits.max_turn_rate_rad_s =
      read_angle(reader, "max_turn_rate_deg_s", limits.max_turn_rate_rad_s, kTurnRate);
  limits.max_turn_acceleration_rad_s2 =
      read_angle(reader, "max_turn_acceleration_deg_s2", limits.max_turn_acceleration_rad_s2,
                 kTurnAcceleration);
  return limits;
}

}  // namespace dottrack::config
