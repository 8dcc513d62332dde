// How a camera stands with the light, against what a reader of the bus has of it.

#include "app/core/protocol/light_message.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_light.h"

namespace dottrack::protocol::test {
namespace {

using exposure::CameraLight;
using exposure::IrisCondition;
using exposure::LightState;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-12;

Reading read(const CameraLight& light, std::uint8_t camera = 0, std::uint8_t sequence = 0) {
  return Reading(std::array{encode_light(camera, light, {}, sequence)});
}

CameraLight steady() {
  CameraLight light;
  light.state = LightState::steady;
  light.setting = {std::chrono::milliseconds(4), 1.5};
  light.opening = 0.5;
  light.iris = IrisCondition::ok;
  return light;
}

std::int64_t raw_exposure(Duration exposure) {
  CameraLight light = steady();
  light.setting.exposure = exposure;
  return read(light).raw("Light.Exposure");
}

std::int64_t raw_gain(double gain) {
  CameraLight light = steady();
  light.setting.gain = gain;
  return read(light).raw("Light.Gain");
}

std::int64_t raw_opening(double opening) {
  CameraLight light = steady();
  light.opening = opening;
  return read(light).raw("Light.Opening");
}

TEST(LightMessage, IsOneFrameUnderTheUnitsIdentifiers) {
  const hal::CanFrame frame =
      encode_light(2, steady(), {.base_id = 0x18FF0000, .extended = true, .fd = true}, 77);
  EXPECT_EQ(frame.id, 0x18FF0000U + 19U);
  EXPECT_TRUE(frame.extended);
  EXPECT_FALSE(frame.fd);
  EXPECT_EQ(frame.length, 8);
  EXPECT_EQ(frame.data[1], 77);
}

TEST(LightMessage, SaysHowTheCameraStands) {
  std::mt19937_64 random(1);
  unsigned set = 0;
  for (unsigned i = 0; i < 5000; ++i) {
    const CameraLight sent = random_light(random);
    const Reading got = read(sent, static_cast<std::uint8_t>(i % 16), static_cast<std::uint8_t>(i));
    ASSERT_EQ(got("Light.Camera"), i % 16);
    ASSERT_EQ(got("Light.Sequence"), i % 256);
    ASSERT_EQ(got("Light.LightState"), static_cast<int>(sent.state));
    ASSERT_EQ(got("Light.Iris"), static_cast<int>(sent.iris));
    if (sent.state == LightState::off) continue;
    ASSERT_NEAR(got("Light.Exposure"), to_seconds(sent.setting.exposure), 0.5e-6 + kTiny);
    ASSERT_NEAR(got("Light.Gain"), sent.setting.gain, 0.005 + kTiny);
    ASSERT_NEAR(got("Light.Opening"), sent.opening, 0.005 + kTiny);
    ++set;
  }
  EXPECT_GT(set, 4000U);
}

TEST(LightMessage, WhileTheLightIsOffNobodyKnowsWhatTheCameraIsSetTo) {
  CameraLight off = steady();
  off.state = LightState::off;
  off.iris = IrisCondition::fault;
  const Reading got = read(off);
  for (const char* name : {"Light.Exposure", "Light.Gain", "Light.Opening"}) {
    EXPECT_FALSE(got.available(name)) << name;
  }
  EXPECT_EQ(got.at("Light.Iris").text, "fault") << "it is known all the same";
}

TEST(LightMessage, ExposureEndsAtItsRange) {
  using std::chrono::microseconds;
  constexpr std::int64_t kNone = (1 << 20) - 1;
  EXPECT_EQ(raw_exposure(Duration(0)), 0);
  EXPECT_EQ(raw_exposure(Duration(499)), 0);
  EXPECT_EQ(raw_exposure(Duration(501)), 1);
  EXPECT_EQ(raw_exposure(microseconds(50)), 50);
  EXPECT_EQ(raw_exposure(std::chrono::seconds(1)), 1'000'000) << "the longest of a rig file";
  EXPECT_EQ(raw_exposure(microseconds(1'048'574)), kNone - 1);
  EXPECT_EQ(raw_exposure(microseconds(1'048'574) + Duration(1)), kNone);
  EXPECT_EQ(raw_exposure(Duration(-1)), kNone);
  EXPECT_EQ(raw_exposure(Duration::max()), kNone);
  EXPECT_EQ(raw_exposure(Duration::min()), kNone);
}

TEST(LightMessage, GainAndOpeningEndAtTheirRanges) {
  EXPECT_EQ(raw_gain(0.0), 0);
  EXPECT_EQ(raw_gain(1.0), 100);
  EXPECT_EQ(raw_gain(40.94), 4094);
  EXPECT_EQ(raw_opening(0.0), 0);
  EXPECT_EQ(raw_opening(1.0), 100);
  for (const double none : {40.941, 1000.0, -1e-300, kNaN, kInf, -kInf}) {
    EXPECT_EQ(raw_gain(none), 4095) << none;
  }
  for (const double none : {1.0 + 1e-9, 2.0, -1e-300, kNaN, kInf, -kInf}) {
    EXPECT_EQ(raw_opening(none), 127) << none;
  }
}

}  // namespace
}  // namespace dottrack::protocol::test
