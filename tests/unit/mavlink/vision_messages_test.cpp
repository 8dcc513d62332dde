// Payloads, field by field, at the offsets that MAVLink's definition gives them.

#include "app/workstation/mavlink/vision_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/unit/mavlink/poses.h"

namespace dottrack::workstation {
namespace {

using testing::yawed;

float float_at(const MavlinkMessage& message, std::size_t offset) {
  float value = 0.0F;
  std::memcpy(&value, message.payload.data() + offset, sizeof(value));
  return value;
}

std::uint64_t time_of(const MavlinkMessage& message) {
  std::uint64_t value = 0;
  std::memcpy(&value, message.payload.data(), sizeof(value));
  return value;
}

// 0.01 in the first, 0.02 in the next and so on, row by row.
Matrix6d counted() {
  Matrix6d matrix;
  int count = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      matrix(row, column) = matrix(column, row) = 0.01 * ++count;
    }
  }
  return matrix;
}

VisionSample sample() {
  VisionSample sample;
  sample.time_us = 0x0102030405060708;
  sample.pose.position_m = {1.5, -2.5, 3.5};
  sample.pose.attitude = yawed(0.5);
  sample.pose.covariance = counted();
  sample.pose.velocity_m_s = Eigen::Vector3d(0.1, 0.2, 0.3);
  sample.pose.rates_rad_s = Eigen::Vector3d(0.4, 0.5, 0.6);
  sample.reset_counter = 200;
  sample.quality = 99;
  return sample;
}

void expect_counted(const MavlinkMessage& message, std::size_t offset) {
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_FLOAT_EQ(float_at(message, offset + 4 * i), 0.01F * static_cast<float>(i + 1)) << i;
  }
}

void expect_unknown(const MavlinkMessage& message, std::size_t offset) {
  EXPECT_TRUE(std::isnan(float_at(message, offset)));
  for (std::size_t i = 1; i < 21; ++i) EXPECT_EQ(float_at(message, offset + 4 * i), 0.0F) << i;
}

TEST(VisionPositionEstimate, HasItsFieldsInPlace) {
  const MavlinkMessage message = vision_position_estimate(sample());
  EXPECT_EQ(message.id, 102U);
  EXPECT_EQ(message.crc_extra, 158);
  ASSERT_EQ(message.length, 117U);
  EXPECT_EQ(time_of(message), 0x0102030405060708U);
  EXPECT_EQ(float_at(message, 8), 1.5F);
  EXPECT_EQ(float_at(message, 12), -2.5F);
  EXPECT_EQ(float_at(message, 16), 3.5F);
  EXPECT_EQ(float_at(message, 20), 0.0F);
  EXPECT_EQ(float_at(message, 24), 0.0F);
  EXPECT_FLOAT_EQ(float_at(message, 28), 0.5F);
  expect_counted(message, 32);
  EXPECT_EQ(message.payload[116], 200);
}

TEST(Odometry, HasItsFieldsInPlace) {
  const MavlinkMessage message = odometry(sample());
  EXPECT_EQ(message.id, 331U);
  EXPECT_EQ(message.crc_extra, 91);
  ASSERT_EQ(message.length, 233U);
  EXPECT_EQ(time_of(message), 0x0102030405060708U);
  EXPECT_EQ(float_at(message, 8), 1.5F);
  EXPECT_FLOAT_EQ(float_at(message, 20), std::cos(0.25F));
  EXPECT_EQ(float_at(message, 24), 0.0F);
  EXPECT_FLOAT_EQ(float_at(message, 32), std::sin(0.25F));
  EXPECT_EQ(float_at(message, 36), 0.1F);
  EXPECT_EQ(float_at(message, 44), 0.3F);
  EXPECT_EQ(float_at(message, 48), 0.4F);
  EXPECT_EQ(float_at(message, 56), 0.6F);
  expect_counted(message, 60);
  expect_unknown(message, 144);
  EXPECT_EQ(message.payload[228], 20);   // local FRD
  EXPECT_EQ(message.payload[229], 12);   // body FRD
  EXPECT_EQ(message.payload[230], 200);  // resets
  EXPECT_EQ(message.payload[231], 2);    // vision
  EXPECT_EQ(message.payload[232], 99);   // percent
}

TEST(Odometry, SaysWhatIsNotKnown) {
  VisionSample unknown = sample();
  unknown.pose.covariance.reset();
  unknown.pose.velocity_m_s.reset();
  unknown.pose.rates_rad_s.reset();
  const MavlinkMessage message = odometry(unknown);
  for (std::size_t offset = 36; offset < 60; offset += 4) {
    EXPECT_TRUE(std::isnan(float_at(message, offset))) << offset;
  }
  expect_unknown(message, 60);
  expect_unknown(vision_position_estimate(unknown), 32);
}

TEST(QualityPercent, NeverSaysMoreThanIsKnown) {
  EXPECT_EQ(quality_percent(-1.0), 0);
  EXPECT_EQ(quality_percent(std::nan("")), 0);
  EXPECT_EQ(quality_percent(0.0), 100);
  EXPECT_EQ(quality_percent(std::ldexp(1.0, -20)), 99);
  EXPECT_EQ(quality_percent(0.5), 50);
  EXPECT_EQ(quality_percent(1.0), 1);
  EXPECT_EQ(quality_percent(7.0), 1);
}

}  // namespace
}  // namespace dottrack::workstation
