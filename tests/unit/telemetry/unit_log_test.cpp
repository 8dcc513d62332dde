#include "app/telemetry/unit_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dottrack::telemetry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class UnitLogTest : public testing::Test {
 protected:
  UnitLogTest() {
    record_.result.cameras[0].delivered = record_.result.cameras[1].delivered = true;
    record_.result.reason = core::Reason::too_few_regions;
  }

  void tick(int times = 1) {
    for (int n = 0; n < times; ++n) {
      ++record_.counters.messages_sent;
      log_.write(record_);
    }
  }
  std::vector<std::string> told() { return std::exchange(lines_, {}); }

  void track() {
    record_.result.state = core::State::tracking;
    record_.result.reason = core::Reason::none;
    record_.result.reset_count = 3;
    record_.result.dots_used = 5;
    record_.result.cameras_used = CameraSet(0b11);
  }

  CycleRecord record_;
  std::vector<std::string> lines_;
  UnitLog log_{{"north", "south"}, [this](Severity severity, const std::string& line) {
                 lines_.push_back(std::to_string(static_cast<int>(severity)) + " " + line);
               }};
};

TEST_F(UnitLogTest, SaysNothingWhileNothingChanges) {
  tick(50);
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(log_.status(), "acquiring (too_few_regions), 2 of 2 cameras, 50 ticks, 0 missed");
}

TEST_F(UnitLogTest, TellsOfALockAndOfItsLossOnce) {
  track();
  tick(4);
  EXPECT_THAT(told(), ElementsAre("6 lock 3: 5 dots, 2 cameras"));
  EXPECT_EQ(log_.status(), "tracking, 2 of 2 cameras, 4 ticks, 0 missed");
  record_.result.state = core::State::acquiring;
  record_.result.reason = core::Reason::too_few_dots;
  tick(4);
  EXPECT_THAT(told(), ElementsAre("4 lock 3 lost: too_few_dots; acquiring again"));
}

TEST_F(UnitLogTest, NamesTheCameraThatHasBeenMoved) {
  record_.result.cameras[1].shift_px = {0.3F, 0.4F};
  tick(3);
  record_.result.cameras[1].moved = true;
  tick(3);
  EXPECT_THAT(told(), ElementsAre("4 camera south: has been moved, its dots are 0.50 pixels off; "
                                  "left out until its model is repaired and the unit is started "
                                  "again"));
  EXPECT_THAT(log_.status(), HasSubstr(", south moved, "));
  record_.result.cameras[1].moved = false;
  tick(3);
  EXPECT_THAT(told(), ElementsAre("6 camera south: counts again"));
  record_.result.rig_disagrees = true;
  tick(3);
  EXPECT_THAT(told(), ElementsAre("4 more cameras contradict each other than can be left out: "
                                  "check the target and the models"));
}

TEST_F(UnitLogTest, NamesTheCameraThatStaysAwayAndItsReturn) {
  record_.result.cameras[1].delivered = false;
  tick(UnitLog::kTicksAway + 5);
  EXPECT_THAT(told(), ElementsAre("4 camera south: delivers no images"));
  EXPECT_THAT(log_.status(), HasSubstr("1 of 2 cameras (without south)"));
  record_.result.cameras[1].delivered = true;
  tick();
  EXPECT_THAT(told(), ElementsAre("6 camera south: is back"));
  EXPECT_THAT(log_.status(), HasSubstr("2 of 2 cameras,"));
}

TEST_F(UnitLogTest, OneLostFrameIsNoNews) {
  for (int n = 0; n < 10; ++n) {
    record_.result.cameras[0].delivered = n % 2 == 0;
    tick();
  }
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(UnitLogTest, TellsWhenPosesDoNotGoOutAndHowManyWereLost) {
  for (int n = 0; n < 7; ++n) {
    ++record_.counters.sends_failed;
    log_.write(record_);
  }
  EXPECT_THAT(told(), ElementsAre("4 CAN: pose frames do not go out"));
  EXPECT_THAT(log_.status(), HasSubstr("CAN silent"));
  tick(2);
  EXPECT_THAT(told(), ElementsAre("6 CAN: pose frames go out again, 7 messages were lost"));
}

TEST_F(UnitLogTest, TellsHowTheControllerStands) {
  record_.can_state = hal::CanState::bus_off;
  tick(3);
  EXPECT_THAT(told(), ElementsAre("4 CAN: bus off"));
  EXPECT_THAT(log_.status(), HasSubstr(", CAN bus off,"));
  record_.can_state = hal::CanState::active;
  tick(3);
  EXPECT_THAT(told(), ElementsAre("6 CAN: in good order"));
}

TEST_F(UnitLogTest, AnIrisThatIsStuckIsTold) {
  record_.unhealthy_irises = CameraSet(0b10);
  tick(3);
  EXPECT_THAT(told(), ElementsAre("4 iris of south: is not where it was sent"));
  record_.unhealthy_irises = CameraSet{};
  tick(3);
  EXPECT_THAT(told(), ElementsAre("6 iris of south: answers again"));
}

TEST_F(UnitLogTest, ABurstOfLossesIsTwoLinesAndNothingIsForgotten) {
  for (int n = 0; n < 150; ++n) {
    ++record_.counters.deadline_misses;
    tick();
  }
  EXPECT_THAT(told(), ElementsAre("4 1 ticks were missed", "4 100 ticks were missed"));
}

TEST_F(UnitLogTest, CommandsAreToldAndAFloodOfThemInOneLine) {
  record_.counters.commands.accepted = 1;
  tick(3);
  EXPECT_THAT(told(), ElementsAre("6 commands over CAN: 1 carried out, 0 refused, 0 corrupted"));
  for (int n = 0; n < 150; ++n) {
    ++record_.counters.commands.rejected;
    tick();
  }
  EXPECT_THAT(told(), ElementsAre("4 commands over CAN: 0 carried out, 98 refused, 0 corrupted"));
  tick(100);
  EXPECT_THAT(told(), ElementsAre("4 commands over CAN: 0 carried out, 52 refused, 0 corrupted"));
}

}  // namespace
}  // namespace dottrack::telemetry
