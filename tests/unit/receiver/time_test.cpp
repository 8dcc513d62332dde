// Age, delay, drift, silence, restart: what the clocks say.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

constexpr std::uint64_t kAgeLimit = 300'000;
constexpr std::uint64_t kRestartGap = 1'000'000;

void hear(Listener& listener, Unit& unit, unsigned groups) {
  for (unsigned i = 0; i < groups; ++i) {
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH) << i;
  }
}

TEST(ReceiverTime, AgeIsThatOfTheMessageWhenNothingDelaysIt) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  EXPECT_EQ(listener.pose().age_us, 20'000U);
  EXPECT_EQ(listener.pose().arrival_us, unit.arrival_us());
}

TEST(ReceiverTime, DelayOnTheWayCountsAsAge) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  ASSERT_EQ(listener.take(unit.next(), 150'000), DOTTRACK_FRESH);
  EXPECT_NEAR(listener.pose().age_us, 170'000.0, 100.0);
}

TEST(ReceiverTime, DelayBeyondTheAgeLimitIsStale) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  unsigned stale = 0;
  for (unsigned i = 0; i < 1000; ++i) {  // for good: waiting makes it no younger
    const Group group = unit.next();
    if (listener.push(group, unit.arrival_us() + 290'000) == DOTTRACK_STALE) ++stale;
    ASSERT_EQ(listener.pose().capture_us, group.capture_us);  // written, to be looked at
    ASSERT_GT(listener.pose().age_us, kAgeLimit);
  }
  EXPECT_EQ(stale, 1000U);
  EXPECT_EQ(listener.counts().stale, 1000U);
  EXPECT_EQ(listener.counts().restarts, 0U);
  EXPECT_EQ(listener.take(unit.next(), 290'000), DOTTRACK_STALE);
  EXPECT_EQ(listener.take(unit.next(), 260'000), DOTTRACK_FRESH);
}

TEST(ReceiverTime, TheAgeLimitIsExact) {
  Unit unit;
  Listener listener;
  unit.shape.age = 3000;
  EXPECT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  unit.shape.age = 3001;
  EXPECT_EQ(listener.take(unit.next()), DOTTRACK_STALE);
  unit.shape.age = 65535;
  EXPECT_EQ(listener.take(unit.next()), DOTTRACK_STALE);
  EXPECT_EQ(listener.pose().age_us, std::numeric_limits<std::uint32_t>::max());
}

TEST(ReceiverTime, ClocksThatDriftApartStayFresh) {
  constexpr unsigned kGroups = 108'000;  // an hour
  for (const double drift : {-100e-6, 0.0, 100e-6}) {
    std::mt19937_64 random(1);
    Unit unit;
    Listener listener;
    std::uint32_t oldest = 0;
    const auto arrival = [&](std::uint64_t jitter) {
      const auto unit_us = static_cast<double>(unit.arrival_us());
      return static_cast<std::uint64_t>(std::llround(unit_us * (1.0 + drift))) + jitter;
    };
    for (unsigned i = 0; i < kGroups; ++i) {
      const Group group = unit.next();
      ASSERT_EQ(listener.push(group, arrival(random() % 2000)), DOTTRACK_FRESH) << i;
      oldest = std::max(oldest, listener.pose().age_us);
    }
    EXPECT_EQ(listener.counts().fresh, kGroups);
    EXPECT_LT(oldest, 20'000U + 2'500U) << drift;
    const Group late = unit.next();
    EXPECT_EQ(listener.push(late, arrival(290'000)), DOTTRACK_STALE) << drift;
  }
}

TEST(ReceiverTime, TheUnitsClockMayWrap) {
  for (const std::uint64_t our_clock : {std::uint64_t{0}, kClockMask, ~std::uint64_t{0} / 2}) {
    Unit unit;
    unit.capture_us = kClockMask - 10'000'000;
    Listener listener;
    for (unsigned i = 0; i < 1000; ++i) {
      const Group group = unit.next();
      ASSERT_EQ(listener.push(group, our_clock + i * Unit::kPeriodUs), DOTTRACK_FRESH) << i;
      ASSERT_EQ(listener.pose().capture_us, group.capture_us);
      ASSERT_EQ(listener.pose().age_us, 20'000U);
    }
    EXPECT_LT(listener.pose().capture_us, 30'000'000U);
    EXPECT_EQ(listener.counts().restarts, 0U);
  }
}

TEST(ReceiverTime, OurClockGoingBackIsNoTime) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 10);
  const std::uint64_t latest = unit.arrival_us();
  EXPECT_EQ(listener.push(unit.next(), 5), DOTTRACK_FRESH);
  EXPECT_EQ(listener.pose().arrival_us, latest);
  EXPECT_EQ(listener.poll(0), DOTTRACK_WAITING);
  EXPECT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
}

TEST(ReceiverTime, AnEarlierCaptureIsStale) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 10);
  unit.capture_us -= 5 * Unit::kPeriodUs;
  EXPECT_EQ(listener.take(unit.next(), 5 * Unit::kPeriodUs), DOTTRACK_STALE);
  EXPECT_EQ(listener.take(unit.next(), 5 * Unit::kPeriodUs), DOTTRACK_STALE);
  EXPECT_EQ(listener.counts().stale, 2U);
  EXPECT_EQ(listener.counts().restarts, 0U);
}

TEST(ReceiverTime, HalfTheClockIsEarlier) {
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 47U;
  for (const auto& [step, verdict] :
       {std::pair{kHalf - 1, DOTTRACK_FRESH}, std::pair{kHalf, DOTTRACK_STALE}}) {
    Unit unit;
    Listener listener;
    ASSERT_EQ(listener.push(unit.next(), 1'000'000), DOTTRACK_FRESH);
    unit.capture_us += step - Unit::kPeriodUs;
    EXPECT_EQ(listener.push(unit.next(), 1'033'333), verdict);
  }
}

TEST(ReceiverTime, ADelayOfHoursIsNotTakenForNone) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  for (std::uint64_t hours = 1; hours <= 5; ++hours) {
    ASSERT_EQ(listener.take(unit.next(), hours * 3'600'000'000), DOTTRACK_STALE) << hours;
  }
  EXPECT_EQ(listener.pose().age_us, std::numeric_limits<std::uint32_t>::max());
}

TEST(ReceiverTime, ThePollSaysWhenThePoseGetsTooOld) {
  Unit unit;
  Listener listener;
  EXPECT_EQ(listener.poll(0), DOTTRACK_STALE);
  hear(listener, unit, 10);
  const std::uint64_t now = unit.arrival_us();
  EXPECT_EQ(listener.poll(now), DOTTRACK_WAITING);
  EXPECT_EQ(listener.poll(now + kAgeLimit - 20'000), DOTTRACK_WAITING);
  EXPECT_EQ(listener.poll(now + kAgeLimit - 20'000 + 1), DOTTRACK_STALE);
  EXPECT_EQ(listener.poll(~std::uint64_t{0}), DOTTRACK_STALE);
}

TEST(ReceiverTime, AUnitThatRestartsIsTakenUpAgain) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  const std::uint64_t last = unit.arrival_us();
  Unit again;
  again.sequence = 0;
  again.capture_us = 1'000'000;
  again.shape.fd = true;
  std::uint64_t now = last + 2 * kRestartGap;
  ASSERT_EQ(listener.push(again.next(), now), DOTTRACK_FRESH);
  EXPECT_TRUE(listener.pose().restarted);
  EXPECT_EQ(listener.pose().age_us, 20'000U);
  EXPECT_EQ(listener.counts().restarts, 1U);
  EXPECT_EQ(listener.counts().silences, 1U);
  EXPECT_EQ(listener.counts().lost_groups, 0U);
  for (unsigned i = 0; i < 10; ++i) {
    now += Unit::kPeriodUs;
    ASSERT_EQ(listener.push(again.next(), now), DOTTRACK_FRESH);
    EXPECT_FALSE(listener.pose().restarted);
  }
}

TEST(ReceiverTime, AUnitThatRestartsIsTakenUpWhateverItsSequence) {
  for (unsigned sequence = 0; sequence <= 255; ++sequence) {
    Unit unit;
    Listener listener;
    hear(listener, unit, 10);
    const std::uint64_t last = unit.arrival_us();
    Unit again;
    again.sequence = static_cast<std::uint8_t>(sequence);
    again.capture_us = 1'000'000;
    ASSERT_EQ(listener.push(again.next(), last + 2 * kRestartGap), DOTTRACK_FRESH) << sequence;
    EXPECT_TRUE(listener.pose().restarted);
  }
}

TEST(ReceiverTime, AUnitThatTookLongToRestartIsTakenUpAgain) {
  Unit unit;  // its clock was at 5 s; it has been up for a minute when it is heard again
  Listener listener;
  hear(listener, unit, 100);
  const std::uint64_t last = unit.arrival_us();
  Unit again;
  again.sequence = 17;
  again.capture_us = 60'000'000;
  // The first group is lost but for a frame: the doubt about the clock outlives it.
  ASSERT_EQ(listener.push(frames_of(again.next()).front(), last + 120'000'000), DOTTRACK_WAITING);
  ASSERT_EQ(listener.push(again.next(), last + 120'033'333), DOTTRACK_FRESH);
  EXPECT_TRUE(listener.pose().restarted);
  EXPECT_EQ(listener.counts().restarts, 1U);
  ASSERT_EQ(listener.push(again.next(), last + 120'066'666), DOTTRACK_FRESH);
  EXPECT_EQ(listener.counts().restarts, 1U);
}

TEST(ReceiverTime, WhatQueuedDuringASilenceIsStaleAndNoRestart) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  const std::uint64_t flood = unit.arrival_us() + 3 * kRestartGap;
  unsigned stale = 0;
  for (unsigned i = 0; i < 50; ++i) {
    if (listener.push(unit.next(), flood) == DOTTRACK_STALE) ++stale;
  }
  EXPECT_EQ(stale, 50U);
  EXPECT_EQ(listener.counts().restarts, 0U);
  while (unit.arrival_us() < flood) (void)unit.next();
  EXPECT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
}

TEST(ReceiverTime, AnOutageIsNoRestart) {
  Unit unit;
  Listener listener;
  hear(listener, unit, 100);
  for (unsigned i = 0; i < 90; ++i) (void)unit.next();  // 3 s
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  EXPECT_FALSE(listener.pose().restarted);
  EXPECT_EQ(listener.counts().silences, 1U);
  EXPECT_EQ(listener.counts().restarts, 0U);
  EXPECT_EQ(listener.counts().lost_groups, 0U);
}

TEST(ReceiverTime, TwoHundredAndFiftySixLostGroupsAreASilence) {
  for (const unsigned lost : {255U, 256U, 257U, 512U}) {
    Unit unit;
    Listener listener;
    hear(listener, unit, 10);
    for (unsigned i = 0; i < lost; ++i) (void)unit.next();
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH) << lost;
    EXPECT_EQ(listener.counts().silences, 1U);
    EXPECT_EQ(listener.counts().restarts, 0U);
    hear(listener, unit, 300);
  }
}

// A unit that restarts so soon that its sequence seems to lie behind is late until the gap is over.
TEST(ReceiverTime, ASequenceThatStaysBehindIsABeginningAfterTheGap) {
  Unit unit;
  unit.sequence = 90;
  Listener listener;
  hear(listener, unit, 10);
  const std::uint64_t last = unit.arrival_us();
  unit.sequence = 0;
  std::uint64_t first_fresh = 0;
  for (unsigned i = 0; i < 60 && first_fresh == 0; ++i) {
    const Group group = unit.next();
    if (listener.push(group, unit.arrival_us()) == DOTTRACK_FRESH) first_fresh = unit.arrival_us();
  }
  EXPECT_GE(first_fresh, last + kRestartGap);
  EXPECT_LE(first_fresh, last + kRestartGap + Unit::kPeriodUs);
}

}  // namespace
}  // namespace dottrack::receiver_test
