#include "app/workstation/mavlink/vision_messages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace dottrack::workstation {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// common.xml
constexpr std::uint8_t kTypeOnboardController = 18;
constexpr std::uint8_t kAutopilotInvalid = 8;
constexpr std::uint8_t kStateActive = 4;
constexpr std::uint8_t kMinorVersion = 3;
constexpr std::uint8_t kFrameBodyFrd = 12;
constexpr std::uint8_t kFrameLocalFrd = 20;
constexpr std::uint8_t kEstimatorVision = 2;

// Appends fields to a message's payload.
class Fields {
 public:
  explicit Fields(std::uint32_t id, std::uint8_t crc_extra) {
    message_.id = id;
    message_.crc_extra = crc_extra;
  }

  void put(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) {
      message_.payload[message_.length++] = static_cast<std::uint8_t>(value >> (8 * i));
    }
  }
  void put_byte(std::uint8_t value) { put(value, 1); }
  void put_float(double value) { put(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4); }
  void put_vector(const Eigen::Vector3d& vector) {
    for (const double value : vector) put_float(value);
  }
  void put_vector_if(const std::optional<Eigen::Vector3d>& vector) {
    put_vector(vector.value_or(Eigen::Vector3d::Constant(kUnknown)));
  }
  // The upper triangle, row by row; NaN first says that it is not known.
  void put_covariance(const std::optional<Matrix6d>& covariance) {
    Matrix6d unknown = Matrix6d::Zero();
    unknown(0, 0) = kUnknown;
    const Matrix6d matrix = covariance.value_or(unknown);
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) put_float(matrix(row, column));
    }
  }

  const MavlinkMessage& message() const { return message_; }

 private:
  MavlinkMessage message_;
};

}  // namespace

MavlinkMessage heartbeat() {
  Fields fields(0, 50);
  fields.put(0, 4);  // custom mode
  fields.put_byte(kTypeOnboardController);
  fields.put_byte(kAutopilotInvalid);
  fields.put_byte(0);  // base mode
  fields.put_byte(kStateActive);
  fields.put_byte(kMinorVersion);
  return fields.message();
}

MavlinkMessage vision_position_estimate(const VisionSample& sample) {
  const EulerAngles angles = euler_angles(sample.pose.attitude);
  Fields fields(102, 158);
  fields.put(sample.time_us, 8);
  fields.put_vector(sample.pose.position_m);
  fields.put_vector({angles.roll, angles.pitch, angles.yaw});
  fields.put_covariance(sample.pose.covariance);
  fields.put_byte(sample.reset_counter);
  return fields.message();
}

MavlinkMessage odometry(const VisionSample& sample) {
  const NedPose& pose = sample.pose;
  Fields fields(331, 91);
  fields.put(sample.time_us, 8);
  fields.put_vector(pose.position_m);
  fields.put_float(pose.attitude.w());
  fields.put_vector(pose.attitude.vec());
  fields.put_vector_if(pose.velocity_m_s);
  fields.put_vector_if(pose.rates_rad_s);
  fields.put_covariance(pose.covariance);
  fields.put_covariance(std::nullopt);  // of the velocity
  fields.put_byte(kFrameLocalFrd);
  fields.put_byte(kFrameBodyFrd);
  fields.put_byte(sample.reset_counter);
  fields.put_byte(kEstimatorVision);
  fields.put_byte(static_cast<std::uint8_t>(sample.quality));
  return fields.message();
}

std::int8_t quality_percent(double false_lock_probability) {
  if (!(false_lock_probability >= 0.0)) return 0;
  const double percent = std::floor(100.0 * (1.0 - std::min(false_lock_probability, 1.0)));
  return static_cast<std::int8_t>(std::max(1.0, percent));
}

}  // namespace dottrack::workstation
