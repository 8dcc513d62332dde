// What an emulated camera answers on endpoint 0.

#include "host_sim/usb_cameras/uvc_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host_sim/usb_cameras/little_endian.h"

namespace dottrack::host_sim {
namespace {

using testing::ElementsAre;

constexpr std::uint8_t kGet = 0x81;
constexpr std::uint8_t kMode = 2;
constexpr std::uint8_t kTime = 4;
constexpr std::uint8_t kGain = 4;

UvcFacts facts() {
  return {"Camera one", "C1", 640, 480, 5.0};
}

hal::ExposureSettings start() {
  return {std::chrono::milliseconds(4), 1.0};
}

class UvcDeviceTest : public testing::Test {
 protected:
  ControlAnswer ask(std::uint8_t type, std::uint8_t request, unsigned value, unsigned index,
                    std::uint16_t length = 256) {
    return device_.control({type, request, static_cast<std::uint16_t>(value),
                            static_cast<std::uint16_t>(index), length},
                           {});
  }
  ControlAnswer tell(std::uint8_t type, std::uint8_t request, unsigned value, unsigned index,
                     const Bytes& data = {}) {
    return device_.control(
        {type, request, static_cast<std::uint16_t>(value), static_cast<std::uint16_t>(index),
         static_cast<std::uint16_t>(data.size())},
        data);
  }
  // Of the terminals and units on interface 0.
  std::optional<std::uint32_t> get(unsigned entity, unsigned selector,
                                   std::uint8_t request = kGet) {
    const ControlAnswer answer = ask(0xa1, request, selector << 8U, entity << 8U);
    if (!answer) return std::nullopt;
    return number_of(*answer);
  }
  bool set(unsigned entity, unsigned selector, const Bytes& data) {
    return tell(0x21, 0x01, selector << 8U, entity << 8U, data).has_value();
  }
  std::uint32_t complaint() { return get(0, 2).value_or(0xff); }

  UvcDevice device_{facts(), start()};
};

// Every descriptor begins with its length; together they fill what the header tells.
TEST_F(UvcDeviceTest, TheConfigurationIsAChainOfDescriptors) {
  const Bytes head = ask(0x80, 6, 0x0200, 0, 9).value();
  ASSERT_EQ(head.size(), 9U) << "cut to what was asked for";
  const Bytes all = ask(0x80, 6, 0x0200, 0, 1024).value();
  ASSERT_EQ(number_of(std::span(head).subspan(2, 2)), all.size());
  std::size_t endpoints = 0;
  std::size_t at = 0;
  while (at < all.size()) {
    ASSERT_GE(all[at], 2U);
    if (all[at + 1] == 5) {
      ++endpoints;
      EXPECT_EQ(all[at + 2], kStreamEndpoint);
    }
    at += all[at];
  }
  EXPECT_EQ(at, all.size());
  EXPECT_EQ(endpoints, 1U);
}

TEST_F(UvcDeviceTest, TellsItsNames) {
  EXPECT_THAT(ask(0x80, 6, 0x0300, 0).value(), ElementsAre(4, 3, 0x09, 0x04));
  EXPECT_THAT(ask(0x80, 6, 0x0303, 0x0409).value(), ElementsAre(6, 3, 'C', 0, '1', 0));
  EXPECT_EQ(ask(0x80, 6, 0x0302, 0x0409).value().size(), 2 + 2 * facts().product.size());
  const Bytes device = ask(0x80, 6, 0x0100, 0).value();
  ASSERT_EQ(device.size(), 18U);
  EXPECT_THAT(std::vector(device.begin() + 14, device.end()), ElementsAre(1, 2, 3, 1));
  EXPECT_EQ(ask(0x80, 6, 0x0600, 0).value().size(), 10U);
}

TEST_F(UvcDeviceTest, HasOneConfigurationAndOneSettingOfEveryInterface) {
  EXPECT_THAT(ask(0x80, 8, 0, 0).value(), ElementsAre(0));
  EXPECT_TRUE(tell(0x00, 9, 1, 0));
  EXPECT_THAT(ask(0x80, 8, 0, 0).value(), ElementsAre(1));
  EXPECT_FALSE(tell(0x00, 9, 2, 0));
  EXPECT_TRUE(tell(0x01, 11, 0, 1));
  EXPECT_FALSE(tell(0x01, 11, 1, 1));
  EXPECT_FALSE(tell(0x01, 11, 0, 2));
  EXPECT_THAT(ask(0x81, 10, 0, 1).value(), ElementsAre(0));
  for (const std::uint8_t recipient : Bytes{0x80, 0x81, 0x82}) {
    EXPECT_THAT(ask(recipient, 0, 0, 0).value(), ElementsAre(0, 0));
  }
  device_.reset();
  EXPECT_EQ(device_.configuration(), 0);
}

TEST_F(UvcDeviceTest, AgreesOnItsOnlyFormatAndStreamsUntilTheHaltIsCleared) {
  const Bytes wanted = ask(0xa1, kGet, 0x0100, 1).value();
  ASSERT_EQ(wanted.size(), 26U);
  EXPECT_EQ(number_of(std::span(wanted).subspan(4, 4)), 2'000'000U);
  EXPECT_EQ(number_of(std::span(wanted).subspan(18, 4)), 640U * 480U);
  EXPECT_TRUE(tell(0x21, 0x01, 0x0100, 1, wanted));
  EXPECT_FALSE(device_.committed());
  EXPECT_FALSE(tell(0x21, 0x01, 0x0200, 1, Bytes(25))) << "too short";
  EXPECT_FALSE(device_.committed());
  EXPECT_TRUE(tell(0x21, 0x01, 0x0200, 1, wanted));
  EXPECT_TRUE(device_.committed());
  EXPECT_TRUE(tell(0x02, 1, 0, kStreamEndpoint));
  EXPECT_FALSE(device_.committed());
  EXPECT_THAT(ask(0xa1, 0x85, 0x0100, 1).value(), ElementsAre(26, 0));
}

TEST_F(UvcDeviceTest, ExposureIsAutomaticUntilItIsSwitchedOff) {
  EXPECT_EQ(get(kCameraTerminal, kMode), 8U);
  EXPECT_EQ(get(kCameraTerminal, kTime, 0x86), 7U) << "disabled by the automatic";
  EXPECT_FALSE(set(kCameraTerminal, kTime, {20, 0, 0, 0}));
  EXPECT_EQ(complaint(), 2U) << "wrong state";
  ASSERT_TRUE(set(kCameraTerminal, kMode, {1}));
  EXPECT_EQ(complaint(), 0U);
  ASSERT_TRUE(set(kCameraTerminal, kTime, {0x2c, 0x01, 0, 0}));
  EXPECT_EQ(get(kCameraTerminal, kTime), 300U);
  EXPECT_EQ(device_.exposure().exposure, std::chrono::milliseconds(30));
  ASSERT_TRUE(set(kCameraTerminal, kMode, {8}));
  EXPECT_EQ(device_.exposure().exposure, start().exposure);
}

TEST_F(UvcDeviceTest, TellsTheLimitsOfItsControlsAndKeepsToThem) {
  ASSERT_TRUE(set(kCameraTerminal, kMode, {1}));
  EXPECT_EQ(get(kCameraTerminal, kTime, 0x82), 1U);
  EXPECT_EQ(get(kCameraTerminal, kTime, 0x83), 2000U) << "a frame's time";
  EXPECT_EQ(get(kCameraTerminal, kTime, 0x87), 40U);
  EXPECT_EQ(get(kCameraTerminal, kTime, 0x85), 4U);
  EXPECT_EQ(get(kProcessingUnit, kGain, 0x82), 100U);
  EXPECT_EQ(get(kProcessingUnit, kGain, 0x83), 400U);
  EXPECT_FALSE(set(kCameraTerminal, kTime, {0, 0, 0, 0}));
  EXPECT_FALSE(set(kProcessingUnit, kGain, {0xff, 0xff}));
  EXPECT_FALSE(set(kCameraTerminal, kMode, {2}));
  EXPECT_EQ(complaint(), 4U) << "out of range";
  EXPECT_TRUE(set(kProcessingUnit, kGain, {250, 0}));
  EXPECT_DOUBLE_EQ(device_.exposure().gain, 2.5);
}

TEST_F(UvcDeviceTest, ControlsOutliveAResetButNotALossOfPower) {
  ASSERT_TRUE(set(kProcessingUnit, kGain, {200, 0}));
  device_.reset();
  EXPECT_DOUBLE_EQ(device_.exposure().gain, 2.0);
  device_.power_up();
  EXPECT_DOUBLE_EQ(device_.exposure().gain, 1.0);
}

TEST_F(UvcDeviceTest, AGainOfTheStartIsWhatAPowerUpGivesBack) {
  UvcDevice bright(facts(), {std::chrono::milliseconds(8), 3.0});
  bright.power_up();
  EXPECT_DOUBLE_EQ(bright.exposure().gain, 3.0);
  EXPECT_EQ(bright.exposure().exposure, std::chrono::milliseconds(8));
}

TEST_F(UvcDeviceTest, StallsWhatItDoesNotKnow) {
  EXPECT_FALSE(ask(0x80, 6, 0x0700, 0)) << "of another speed";
  EXPECT_FALSE(ask(0x80, 6, 0x0201, 0)) << "a second configuration";
  EXPECT_FALSE(ask(0x80, 6, 0x0304, 0x0409)) << "a fourth string";
  EXPECT_FALSE(ask(0xc0, 1, 0, 0)) << "of a vendor";
  EXPECT_FALSE(tell(0x00, 3, 1, 0)) << "remote wake-up";
  EXPECT_FALSE(ask(0xa1, kGet, 0x0300, 1)) << "a still picture";
  EXPECT_FALSE(get(7, 1));
  EXPECT_EQ(complaint(), 5U) << "no such unit";
  EXPECT_FALSE(get(kCameraTerminal, 6));
  EXPECT_EQ(complaint(), 6U) << "no such control";
  EXPECT_FALSE(get(kCameraTerminal, kTime, 0x88));
  EXPECT_EQ(complaint(), 7U) << "no such request";
  EXPECT_FALSE(set(kCameraTerminal, kMode, {1, 0})) << "too long";
}

}  // namespace
}  // namespace dottrack::host_sim
