#include "drivers/libcamera/frame_sync.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace dottrack::drivers {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Duration kPeriod = std::chrono::milliseconds(100);

constexpr Time at(int ms) {
  return Time(std::chrono::milliseconds(1'000'000 + ms));
}

// Frames are named by the time of their exposure, in milliseconds, times the camera's number.
class Sync : public testing::Test, public LateFrames {
 protected:
  static constexpr CameraSet kAll{0b111};

  // A frame exposed at one time that the tick sees at another.
  void frame(std::size_t camera, int exposed_ms, int seen_ms) {
    sync().add(camera, {.mid_exposure = at(exposed_ms), .sequence = next_++, .buffer = 0},
               at(seen_ms));
  }
  void frames(int exposed_ms, int seen_ms) {
    for (std::size_t camera = 0; camera < 3; ++camera) frame(camera, exposed_ms, seen_ms);
  }

  CameraSet take(int now_ms, CameraSet expected = kAll, CameraSet wanted = kAll) {
    return sync().take(expected, wanted, at(now_ms));
  }
  int exposed_ms(std::size_t camera) {
    return static_cast<int>((sync().taken(camera).mid_exposure - at(0)) /
                            std::chrono::milliseconds(1));
  }

  void give_back_late(std::size_t camera, const Arrival& frame) override {
    late_.push_back(static_cast<int>((frame.mid_exposure - at(0)) / std::chrono::milliseconds(1)));
    (void)camera;
  }
  virtual FrameSync& sync() { return sync_; }

  std::vector<int> late_;  // exposures

 private:
  FrameSync sync_{kPeriod, false, *this};
  std::uint32_t next_ = 0;
};

class TriggeredSync : public Sync {
 protected:
  FrameSync& sync() override { return sync_; }

 private:
  FrameSync sync_{kPeriod, true, *this};
};

TEST_F(Sync, WithoutFramesNothingIsTaken) {
  sync().begin(at(0));
  EXPECT_FALSE(sync().complete(kAll, kAll));
  EXPECT_TRUE(take(50).empty());
}

TEST_F(Sync, AGroupIsCompleteWithItsLastCamera) {
  sync().begin(at(0));
  frame(0, 0, 10);
  frame(2, 20, 30);
  EXPECT_FALSE(sync().complete(kAll, kAll));
  frame(1, 5, 35);
  EXPECT_TRUE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(35), kAll);
  EXPECT_EQ(exposed_ms(0), 0);
  EXPECT_EQ(exposed_ms(1), 5);
  EXPECT_EQ(exposed_ms(2), 20);
  EXPECT_THAT(late_, IsEmpty());
}

TEST_F(Sync, FramesMoreThanAQuarterOfAPeriodApartAreNoGroup) {
  sync().begin(at(0));
  frame(0, 0, 60);
  frame(1, 10, 60);
  frame(2, 26, 60);
  EXPECT_FALSE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(90), CameraSet(0b110)) << "of two groups of two, the newer";
  EXPECT_THAT(late_, ElementsAre(0));
}

TEST_F(Sync, NoFrameIsTakenTwice) {
  sync().begin(at(0));
  frames(0, 10);
  take(10);
  sync().begin(at(100));
  EXPECT_FALSE(sync().complete(kAll, kAll));
  EXPECT_TRUE(take(150).empty());
}

TEST_F(Sync, AStragglerOfTheGroupTakenIsLate) {
  sync().begin(at(0));
  frame(0, 0, 10);
  frame(1, 0, 10);
  EXPECT_EQ(take(50), CameraSet(0b011));
  frame(2, 24, 60);
  EXPECT_THAT(late_, ElementsAre(24));
  sync().begin(at(100));
  frames(100, 120);
  EXPECT_EQ(take(120), kAll);
}

TEST_F(Sync, OfTwoCompleteGroupsTheNewerIsTaken) {
  frames(0, 10);
  frames(100, 110);
  sync().begin(at(150));
  EXPECT_TRUE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(150), kAll);
  EXPECT_EQ(exposed_ms(0), 100);
  EXPECT_THAT(late_, ElementsAre(0, 0, 0));
}

TEST_F(Sync, ACompleteGroupIsTakenWhileANewerOneIsArriving) {
  frames(0, 10);
  frame(1, 100, 105);
  sync().begin(at(105));
  EXPECT_TRUE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(105), kAll);
  EXPECT_EQ(exposed_ms(1), 0);
  frame(0, 100, 106);
  frame(2, 100, 107);
  sync().begin(at(205));
  EXPECT_EQ(take(205), kAll);
  EXPECT_EQ(exposed_ms(1), 100);
  EXPECT_THAT(late_, IsEmpty());
}

TEST_F(Sync, ACompleteGroupTwoExposuresBackIsNotTakenBeforeTheDeadline) {
  frames(0, 10);
  frame(1, 200, 205);
  sync().begin(at(205));
  EXPECT_FALSE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(255), kAll) << "the most cameras";
  EXPECT_EQ(exposed_ms(0), 0);
}

TEST_F(Sync, AtTheDeadlineTheMostCamerasAreTaken) {
  sync().begin(at(100));
  frame(0, 0, 100);
  frame(1, 0, 100);
  frame(2, 100, 130);
  EXPECT_EQ(take(150), CameraSet(0b011));
  EXPECT_THAT(late_, IsEmpty());
  sync().begin(at(200));
  EXPECT_EQ(take(250), CameraSet(0b100)) << "what was newer is still there";
}

TEST_F(Sync, AtTheDeadlineTheNewerOfTwoEqualGroupsIsTaken) {
  sync().begin(at(100));
  frame(0, 0, 100);
  frame(2, 100, 130);
  EXPECT_EQ(take(150), CameraSet(0b100));
  EXPECT_THAT(late_, ElementsAre(0));
}

TEST_F(Sync, AGroupThatIsStillArrivingAtTheDeadlineIsLeftForTheNextTick) {
  sync().begin(at(0));
  frame(0, 0, 45);
  frame(1, 0, 49);
  EXPECT_TRUE(take(50).empty());
  frame(2, 0, 52);
  sync().begin(at(100));
  EXPECT_TRUE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(100), kAll);
  EXPECT_THAT(late_, IsEmpty());
}

TEST_F(Sync, AGroupWithALostFrameIsTakenInTheNextTickAtTheLatest) {
  sync().begin(at(0));
  frame(0, 0, 45);
  frame(1, 0, 49);
  EXPECT_TRUE(take(50).empty());
  sync().begin(at(100));
  frame(0, 100, 145);
  frame(1, 100, 149);
  EXPECT_EQ(take(150), CameraSet(0b011));
  EXPECT_EQ(exposed_ms(0), 0);
}

TEST_F(Sync, OnlyExpectedCamerasAreTakenAndTheOthersFramesAreGivenBack) {
  sync().begin(at(0));
  frames(0, 10);
  EXPECT_TRUE(sync().complete(CameraSet(0b100), CameraSet(0b100)));
  EXPECT_EQ(take(10, CameraSet(0b100), CameraSet(0b100)), CameraSet(0b100));
  EXPECT_THAT(late_, ElementsAre(0, 0));
}

TEST_F(Sync, ACameraThatIsAwayIsNotWaitedForButItsFrameIsTaken) {
  const CameraSet present(0b011);
  sync().begin(at(0));
  frame(0, 0, 10);
  frame(2, 0, 10);
  EXPECT_FALSE(sync().complete(kAll, present));
  frame(1, 0, 11);
  EXPECT_TRUE(sync().complete(kAll, present));
  EXPECT_EQ(take(11, kAll, present), kAll);
}

TEST_F(Sync, WithNoCameraPresentThereIsNothingToWaitFor) {
  sync().begin(at(0));
  EXPECT_TRUE(sync().complete(kAll, CameraSet{}));
  EXPECT_TRUE(take(0, kAll, CameraSet{}).empty());
}

TEST_F(Sync, OfMoreThanTwoWaitingFramesTheOldestIsGivenBack) {
  frame(0, 0, 10);
  frame(0, 100, 110);
  frame(0, 200, 210);
  EXPECT_THAT(late_, ElementsAre(0));
}

TEST_F(Sync, AFrameThatWaitedForThreePeriodsIsGivenBack) {
  frames(0, 10);
  sync().begin(at(299));
  EXPECT_THAT(late_, IsEmpty());
  sync().begin(at(301));
  EXPECT_THAT(late_, ElementsAre(0, 0, 0));
}

TEST_F(Sync, AStampFromTheFutureIsNotBelieved) {
  sync().begin(at(0));
  frame(0, 101, 0);
  EXPECT_THAT(late_, ElementsAre(101));
  frames(0, 10);
  EXPECT_EQ(take(10), kAll);
}

TEST_F(TriggeredSync, WhatWasExposedBeforeTheTriggerIsLate) {
  frame(0, -60, -10);
  sync().begin(at(0));
  frame(1, -30, 1);
  EXPECT_THAT(late_, ElementsAre(-60, -30));
  EXPECT_TRUE(take(50).empty());
}

TEST_F(TriggeredSync, TheTickIsCompleteWithTheLastCameraThatWasTriggered) {
  sync().begin(at(0));
  frame(0, 2, 20);
  frame(1, 2, 20);
  EXPECT_FALSE(sync().complete(kAll, kAll));
  frame(2, 2, 21);
  EXPECT_TRUE(sync().complete(kAll, kAll));
  EXPECT_EQ(take(21), kAll);
  EXPECT_THAT(late_, IsEmpty());
}

TEST_F(TriggeredSync, AtTheDeadlineThoseThatCameAreTakenAndTheRestIsLateInTheNextTick) {
  sync().begin(at(0));
  frame(0, 2, 49);
  EXPECT_EQ(take(50), CameraSet(0b001));
  frame(1, 2, 60);
  sync().begin(at(100));
  EXPECT_THAT(late_, ElementsAre(2));
  frames(102, 120);
  EXPECT_EQ(take(120), kAll);
  EXPECT_EQ(exposed_ms(1), 102);
}

TEST_F(TriggeredSync, AClockThatIsALittleBehindLosesNothing) {
  sync().begin(at(0));
  frames(-20, 10);
  EXPECT_EQ(take(10), kAll);
}

}  // namespace
}  // namespace dottrack::drivers
