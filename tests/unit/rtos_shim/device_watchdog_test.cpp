#include "rtos_shim/posix_rt/device_watchdog.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

namespace dottrack::rtos {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

std::string error_of(const std::string& device) {
  const auto opened = DeviceWatchdog::open(device, seconds(10));
  return opened ? "opened" : opened.error().message;
}

TEST(DeviceWatchdog, WhatIsNotAWatchdogIsAnErrorThatSaysSo) {
  EXPECT_EQ(error_of("/dev/null"),
            "/dev/null: not a watchdog; expected a device such as /dev/watchdog0");
}

TEST(DeviceWatchdog, WhatIsNotThereIsAnErrorThatSaysSo) {
  EXPECT_THAT(error_of("/dev/no-such-watchdog"), HasSubstr("/dev/no-such-watchdog: cannot be"));
  EXPECT_THAT(error_of("/dev"), HasSubstr("/dev: cannot be opened: "));
}

// In the place of the device: what is written to it can be read.
class Told : public testing::Test {
 protected:
  Told() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC), 0);
    ear_ = FileDescriptor(ends[0]);
    device_ = FileDescriptor(ends[1]);
  }
  std::string heard() const {
    std::array<char, 64> words{};
    const ssize_t count = read(ear_.get(), words.data(), words.size());
    return count > 0 ? std::string(words.data(), static_cast<std::size_t>(count)) : "";
  }
  bool is_closed() const {
    char word = 0;
    return read(ear_.get(), &word, 1) == 0;
  }

  FileDescriptor ear_, device_;
};

TEST_F(Told, AKickIsAWordThatDoesNotDisarm) {
  DeviceWatchdog watchdog(std::move(device_), seconds(10));
  watchdog.kick();
  watchdog.kick();
  EXPECT_EQ(heard(), std::string(2, '\0'));
}

TEST_F(Told, DisarmingIsTheMagicWordAndTheEnd) {
  DeviceWatchdog watchdog(std::move(device_), seconds(10));
  watchdog.disarm();
  EXPECT_EQ(heard(), "V");
  EXPECT_TRUE(is_closed());
  watchdog.kick();
  watchdog.disarm();
}

TEST_F(Told, ItsEndAloneDoesNotDisarm) {
  { const DeviceWatchdog watchdog(std::move(device_), seconds(10)); }
  EXPECT_TRUE(is_closed());
}

}  // namespace
}  // namespace dottrack::rtos
