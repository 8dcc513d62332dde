// Whatever a light holds, its frame is whole, within the DBC's ranges, and what is read and sent
// again is the same.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "app/core/protocol/e2e.h"
#include "app/core/protocol/light_message.h"
#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_light.h"

namespace dottrack::protocol::test {
namespace {

using exposure::CameraLight;
using exposure::LightState;

constexpr std::array<const char*, 3> kQuantities{"Light.Exposure", "Light.Gain", "Light.Opening"};

double odd_number(std::mt19937_64& random) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::array kOdd{std::numeric_limits<double>::quiet_NaN(),
                            kInf,
                            -kInf,
                            -0.0,
                            1e300,
                            1e-310,
                            40.945,
                            1.004,
                            -0.001};
  return kOdd.at(random() % kOdd.size());
}

CameraLight odd_light(std::mt19937_64& random) {
  CameraLight light = random_light(random);
  if (random() % 4 == 0) light.setting.gain = odd_number(random);
  if (random() % 4 == 0) light.opening = odd_number(random);
  if (random() % 4 == 0) {
    light.setting.exposure = Duration(static_cast<std::int64_t>(random()) >> (random() % 64U));
  }
  return light;
}

bool sound(const hal::CanFrame& frame) {
  const std::uint64_t word = to_word(frame.data.data());
  const auto data_id = static_cast<std::uint16_t>(frame.id - kDefaultBaseId + 1);
  return get(Field{0, 8}, word) == e2e::profile2_crc(word, data_id);
}

TEST(Light, OfAnythingIsWithinTheRangesOfTheDbc) {
  std::mt19937_64 random(1);
  unsigned available = 0;
  unsigned refused = 0;
  for (unsigned i = 0; i < 20'000; ++i) {
    const CameraLight light = odd_light(random);
    const Reading got(std::array{encode_light(static_cast<std::uint8_t>(i % 16), light, {}, 0)});
    ASSERT_EQ(got("Light.Camera"), i % 16);
    ASSERT_EQ(got("Light.LightState"), static_cast<int>(light.state));
    for (const char* name : kQuantities) {
      if (!got.available(name)) {
        ++refused;
        continue;
      }
      ASSERT_NE(light.state, LightState::off);
      ASSERT_GE(got(name), got.at(name).signal->minimum - 1e-9) << name;
      ASSERT_LE(got(name), got.at(name).signal->maximum + 1e-9) << name;
      ++available;
    }
  }
  EXPECT_GT(available, 20'000U);
  EXPECT_GT(refused, 5'000U);
}

TEST(Light, OneFlippedBitIsFoundOut) {
  std::mt19937_64 random(2);
  std::size_t flips = 0;
  for (unsigned i = 0; i < 500; ++i) {
    hal::CanFrame frame = encode_light(static_cast<std::uint8_t>(i % 16), odd_light(random), {},
                                       static_cast<std::uint8_t>(random()));
    ASSERT_TRUE(sound(frame));
    for (unsigned bit = 0; bit < 64; ++bit) {
      frame.data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      ASSERT_FALSE(sound(frame)) << bit;
      frame.data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      ++flips;
    }
  }
  EXPECT_EQ(flips, 500U * 64U);
}

TEST(Light, ReadAndSentAgainIsTheSame) {
  unsigned wrong = 0;
  unsigned numbers = 0;
  const auto sent_again = [&](std::int64_t exposure, std::int64_t gain, std::int64_t opening) {
    CameraLight light;
    light.state = LightState::steady;
    light.setting = {exposure * std::chrono::microseconds(1), 0.01 * static_cast<double>(gain)};
    light.opening = 0.01 * static_cast<double>(opening);
    const Reading got(std::array{encode_light(5, light, {}, 0)});
    const bool same = got.raw("Light.Exposure") == exposure && got.raw("Light.Gain") == gain &&
                      got.raw("Light.Opening") == opening;
    wrong += same ? 0U : 1U;
    ++numbers;
  };
  for (std::int64_t exposure = 0; exposure < 1'048'575; exposure += 37) {
    sent_again(exposure, exposure % 4095, exposure % 101);
  }
  for (std::int64_t gain = 0; gain <= 4094; ++gain) sent_again(1'048'574, gain, 100);
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(numbers, 30'000U);
}

}  // namespace
}  // namespace dottrack::protocol::test
