#include "drivers/socketcan/controller_state.h"

#include <gtest/gtest.h>

namespace dottrack::drivers {
namespace {

using hal::CanState;
using std::chrono::milliseconds;

constexpr ErrorReport kBusOff{.bus_off = true, .restarted = false, .fault = {}, .counts = {}};
constexpr ErrorReport kRestarted{.bus_off = false, .restarted = true, .fault = {}, .counts = {}};

ErrorReport fault(CanState state) {
  return {.bus_off = false, .restarted = false, .fault = state, .counts = {}};
}
ErrorReport counters(CanState state) {
  return {.bus_off = false, .restarted = false, .fault = {}, .counts = state};
}

class ControllerStateTest : public testing::Test {
 protected:
  void link(LinkState link) { add(controller_.on_link(link, now_)); }
  void report(const ErrorReport& report) { add(controller_.on_report(report, now_)); }
  void pass(Duration time) { now_ += time; }
  void add(ControllerState::Change change) {
    bus_offs_ += change.bus_off ? 1 : 0;
    recoveries_ += change.recovered ? 1 : 0;
  }
  CanState state() const { return controller_.state(); }

  ControllerState controller_;
  Time now_{milliseconds(5000)};
  int bus_offs_ = 0;
  int recoveries_ = 0;
};

TEST_F(ControllerStateTest, ComingUpForTheFirstTimeIsNoRecovery) {
  EXPECT_EQ(state(), CanState::absent);
  link(LinkState::down);
  EXPECT_EQ(state(), CanState::absent);
  link(LinkState::running);
  EXPECT_EQ(state(), CanState::active);
  EXPECT_EQ(recoveries_, 0);
}

TEST_F(ControllerStateTest, FaultsComeAndGoWithoutAnOutage) {
  link(LinkState::running);
  for (const CanState told : {CanState::warning, CanState::passive, CanState::active}) {
    report(fault(told));
    EXPECT_EQ(state(), told);
    EXPECT_TRUE(controller_.can_send());
  }
  report(counters(CanState::passive));
  EXPECT_EQ(state(), CanState::passive);
  link(LinkState::running);
  EXPECT_EQ(state(), CanState::passive) << "the flags know nothing of error counters";
  EXPECT_EQ(recoveries_, 0);
}

TEST_F(ControllerStateTest, BusOffEndsWithTheRestart) {
  link(LinkState::running);
  report(kBusOff);
  EXPECT_EQ(state(), CanState::bus_off);
  EXPECT_FALSE(controller_.can_send());
  report(kBusOff);
  report(counters(CanState::active));
  EXPECT_EQ(state(), CanState::bus_off) << "counters restart at zero before the controller does";
  report(kRestarted);
  EXPECT_EQ(state(), CanState::active);
  EXPECT_EQ(bus_offs_, 1);
  EXPECT_EQ(recoveries_, 1);
}

TEST_F(ControllerStateTest, FlagsThatLagBehindTheErrorFramesAreNotBelieved) {
  link(LinkState::running);
  report(kBusOff);
  pass(milliseconds(20));
  link(LinkState::running);
  EXPECT_EQ(state(), CanState::bus_off);
  report(kRestarted);
  pass(milliseconds(20));
  link(LinkState::no_carrier);
  EXPECT_EQ(state(), CanState::active);
  EXPECT_EQ(bus_offs_, 1);
}

TEST_F(ControllerStateTest, FlagsEndABusOffWhoseRestartWasNotHeard) {
  link(LinkState::running);
  report(kBusOff);
  pass(milliseconds(3000));
  link(LinkState::running);
  EXPECT_EQ(state(), CanState::active);
  EXPECT_EQ(recoveries_, 1);
}

TEST_F(ControllerStateTest, ALinkWithoutCarrierIsOffTheBus) {
  link(LinkState::no_carrier);
  EXPECT_EQ(state(), CanState::bus_off);
  link(LinkState::running);
  EXPECT_EQ(state(), CanState::active);
  link(LinkState::no_carrier);
  EXPECT_EQ(state(), CanState::bus_off);
  EXPECT_EQ(bus_offs_, 2);
}

TEST_F(ControllerStateTest, DownAndUpAgainEndsABusOff) {
  link(LinkState::running);
  report(kBusOff);
  link(LinkState::down);
  EXPECT_EQ(state(), CanState::absent);
  link(LinkState::no_carrier);
  EXPECT_EQ(bus_offs_, 1) << "the carrier of before is no new bus-off";
  link(LinkState::running);
  EXPECT_EQ(state(), CanState::active);
  EXPECT_EQ(recoveries_, 1);
}

TEST_F(ControllerStateTest, ReportsFromBeforeTheLinkWentAreIgnored) {
  link(LinkState::running);
  link(LinkState::gone);
  report(kRestarted);
  report(fault(CanState::warning));
  report(kBusOff);
  EXPECT_EQ(state(), CanState::absent);
  EXPECT_EQ(bus_offs_, 0);
  EXPECT_EQ(recoveries_, 0);
}

}  // namespace
}  // namespace dottrack::drivers
