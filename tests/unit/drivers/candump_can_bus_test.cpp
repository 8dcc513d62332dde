#include "drivers/candump/candump_can_bus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::drivers {
namespace {

using testing::HasSubstr;

class Candump : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = CandumpCanBus::open(path_, clock_, "can1");
    ASSERT_TRUE(opened) << opened.error().message;
    bus_ = std::move(*opened);
  }
  std::string log() {
    EXPECT_TRUE(bus_->flush());
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }
  static hal::CanFrame frame(std::uint32_t id) {
    hal::CanFrame made;
    made.id = id;
    made.length = 3;
    made.data = {0xDE, 0xAD, 0x01};
    return made;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "can.log";
  rtos::VirtualClock clock_;
  std::unique_ptr<CandumpCanBus> bus_;
};

TEST_F(Candump, WritesTheLinesOfCandumpL) {
  clock_.jump_to(Time(std::chrono::microseconds(1234567)));
  bus_->send(frame(0x12), Time{});
  hal::CanFrame extended = frame(0x12345);
  extended.extended = true;
  bus_->send(extended, Time{});
  hal::CanFrame fd = frame(0x7FF);
  fd.fd = fd.bit_rate_switch = true;
  bus_->send(fd, Time{});
  EXPECT_EQ(log(),
            "(0000000001.234567) can1 012#DEAD01\n"
            "(0000000001.234567) can1 00012345#DEAD01\n"
            "(0000000001.234567) can1 7FF##1DEAD01\n");
}

TEST_F(Candump, SaysTryAgainWhenNobodyEmptiesIt) {
  int accepted = 0;
  while (accepted < 100000 && bus_->send(frame(1), Time{}) == hal::SendResult::accepted) ++accepted;
  EXPECT_GT(accepted, 500);
  EXPECT_EQ(bus_->send(frame(1), Time{}), hal::SendResult::try_again);
  ASSERT_TRUE(bus_->flush());
  EXPECT_EQ(bus_->send(frame(1), Time{}), hal::SendResult::accepted);
}

TEST_F(Candump, AFullDiskIsOneLineAndADeadBus) {
  auto full = CandumpCanBus::open("/dev/full", clock_);
  ASSERT_TRUE(full);
  (*full)->send(frame(1), Time{});
  const Result<void> flushed = (*full)->flush();
  ASSERT_FALSE(flushed);
  EXPECT_THAT(flushed.error().message, HasSubstr("/dev/full: cannot write (No space left"));
  EXPECT_EQ((*full)->state(), hal::CanState::absent);
  EXPECT_EQ((*full)->send(frame(1), Time{}), hal::SendResult::failed);
}

TEST_F(Candump, AFileThatCannotBeMadeIsAnError) {
  const auto opened = CandumpCanBus::open(folder_.path() / "none" / "can.log", clock_);
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("can.log: cannot write (No such file"));
}

}  // namespace
}  // namespace dottrack::drivers
