// How frames become groups: order, completeness, sequence.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

Group full_group(Unit& unit) {
  Group group = unit.next();
  group.covariance = group.motion = group.cameras = true;
  group.dots_follow = 4;
  return group;
}

TEST(ReceiverGroup, FaultFreeStreamsAreFreshOneByOne) {
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    Listener listener;
    std::uint64_t frames = 0;
    for (unsigned i = 0; i < 10'000; ++i) {
      const Frames sent = frames_of(i % 10 == 0 ? full_group(unit) : unit.next());
      frames += sent.size();
      ASSERT_EQ(listener.push(sent, unit.arrival_us()), DOTTRACK_FRESH) << i;
      ASSERT_EQ(listener.pose().capture_us, unit.capture_us - Unit::kPeriodUs);
    }
    EXPECT_EQ(listener.counts().frames, frames);
    EXPECT_EQ(listener.counts().fresh, 10'000U);
    EXPECT_EQ(listener.verdicts(DOTTRACK_FRESH), 10'000U);
    EXPECT_EQ(listener.verdicts(DOTTRACK_WAITING), frames - 10'000U);
  }
}

TEST(ReceiverGroup, OrderWithinAGroupDoesNotMatter) {
  std::mt19937_64 random(1);
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    Listener listener;
    for (unsigned i = 0; i < 2000; ++i) {
      Frames frames = frames_of(full_group(unit));
      std::shuffle(frames.begin(), frames.end(), random);
      ASSERT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_FRESH);
    }
    EXPECT_EQ(listener.counts().fresh, 2000U);
    EXPECT_EQ(listener.counts().incomplete, 0U);
  }
}

TEST(ReceiverGroup, NoneOfTheAnnouncedFramesMayBeMissing) {
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    const std::size_t size = frames_of(full_group(unit)).size();
    EXPECT_EQ(size, fd ? 12U : 22U);
    for (std::size_t missing = 0; missing < size; ++missing) {
      Listener listener;
      ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
      Frames frames = frames_of(full_group(unit));
      frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(missing));
      ASSERT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_WAITING) << missing;
      // A whole group of one frame completes, of more it first says that the one before ended.
      const Frames next = frames_of(unit.next());
      const dottrack_verdict first = listener.push(next.front(), unit.arrival_us());
      EXPECT_EQ(first, fd ? DOTTRACK_FRESH : DOTTRACK_INCOMPLETE);
      EXPECT_EQ(listener.counts().incomplete, 1U);
    }
  }
}

TEST(ReceiverGroup, AGroupMayBeJoinedInTheMiddle) {
  Unit unit;
  Listener listener;
  Frames frames = frames_of(full_group(unit));
  frames.erase(frames.begin(), frames.begin() + 3);
  EXPECT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_WAITING);
  EXPECT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  EXPECT_EQ(listener.verdicts(DOTTRACK_INCOMPLETE), 0U);
  EXPECT_EQ(listener.counts().incomplete, 0U);
  EXPECT_EQ(listener.counts().lost_groups, 0U);
}

TEST(ReceiverGroup, AFrameThatWasHereIsRepeated) {
  Unit unit;
  Listener listener;
  const Frames frames = frames_of(full_group(unit));
  std::uint64_t repeated = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    (void)listener.push(frames[i], unit.arrival_us());
    for (std::size_t k = 0; k <= i; ++k) {
      ASSERT_EQ(listener.push(frames[k], unit.arrival_us()), DOTTRACK_REPEATED);
      ++repeated;
    }
  }
  EXPECT_EQ(listener.counts().repeated_frames, repeated);
  EXPECT_EQ(listener.counts().fresh, 1U);
  EXPECT_EQ(repeated, 22U * 23U / 2U);
}

TEST(ReceiverGroup, AGroupThatComesAgainLaterIsRepeated) {
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    Listener listener;
    const Frames frames = frames_of(unit.next());
    ASSERT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_FRESH);
    EXPECT_EQ(listener.push(frames, unit.arrival_us() + 200'000), DOTTRACK_REPEATED);
    EXPECT_EQ(listener.push(frames, unit.arrival_us() + 5'000'000), DOTTRACK_REPEATED);
    EXPECT_EQ(listener.counts().repeated_groups, 2U);
    EXPECT_EQ(listener.counts().fresh, 1U);
  }
}

TEST(ReceiverGroup, FramesOfAGroupThatWasOvertakenAreLate) {
  Unit unit;
  Listener listener;
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  const Frames overtaken = frames_of(unit.next());
  const Frames next = frames_of(unit.next());
  EXPECT_EQ(listener.push(next, unit.arrival_us()), DOTTRACK_FRESH);
  EXPECT_EQ(listener.counts().lost_groups, 1U);
  for (const dottrack_frame& frame : overtaken) {
    EXPECT_EQ(listener.push(frame, unit.arrival_us()), DOTTRACK_STALE);
  }
  EXPECT_EQ(listener.counts().late_frames, overtaken.size());
  EXPECT_EQ(listener.counts().stale, 0U);
}

TEST(ReceiverGroup, LateFramesDoNotDisturbTheOpenGroup) {
  Unit unit;
  Listener listener;
  const Frames old = frames_of(unit.next());
  const Frames open = frames_of(unit.next());
  for (std::size_t i = 0; i < open.size(); ++i) {
    const dottrack_verdict expected = i + 1 < open.size() ? DOTTRACK_WAITING : DOTTRACK_FRESH;
    EXPECT_EQ(listener.push(open[i], unit.arrival_us()), expected);
    EXPECT_EQ(listener.push(old[i], unit.arrival_us()), DOTTRACK_STALE);
  }
  EXPECT_EQ(listener.counts().late_frames, old.size());
}

TEST(ReceiverGroup, AGroupThatTakesTooLongIsGivenUp) {
  Unit unit;
  Listener listener;
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  const Frames frames = frames_of(unit.next());
  const std::uint64_t now = unit.arrival_us();
  ASSERT_EQ(listener.push(frames[0], now), DOTTRACK_WAITING);
  EXPECT_EQ(listener.poll(now + 100'000), DOTTRACK_WAITING);
  EXPECT_EQ(listener.poll(now + 100'001), DOTTRACK_INCOMPLETE);
  EXPECT_EQ(listener.poll(now + 100'002), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(frames[1], now + 100'003), DOTTRACK_STALE);
  EXPECT_EQ(listener.push(frames[2], now + 900'000), DOTTRACK_STALE);
  EXPECT_EQ(listener.counts().incomplete, 1U);
  EXPECT_EQ(listener.counts().late_frames, 2U);
}

TEST(ReceiverGroup, AFrameThatComesTooLateGivesItsOwnGroupUp) {
  Unit unit;
  Listener listener;
  ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
  Frames frames = frames_of(unit.next());
  const dottrack_frame last = frames.back();
  frames.pop_back();
  ASSERT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(last, unit.arrival_us() + 100'001), DOTTRACK_STALE);
  EXPECT_EQ(listener.counts().incomplete, 1U);
  EXPECT_EQ(listener.counts().late_frames, 1U);
  EXPECT_EQ(listener.counts().fresh, 1U);
}

TEST(ReceiverGroup, LostGroupsAreCountedByTheSequence) {
  for (unsigned lost = 0; lost <= 126; ++lost) {
    Unit unit;
    unit.sequence = 200;
    Listener listener;
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
    // So quick a unit that there is no silence.
    unit.sequence = static_cast<std::uint8_t>(unit.sequence + lost);
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
    EXPECT_EQ(listener.counts().lost_groups, lost);
    EXPECT_EQ(listener.counts().silences, 0U);
  }
}

TEST(ReceiverGroup, HalfTheSequencesAreBehind) {
  for (unsigned ahead = 1; ahead <= 255; ++ahead) {
    Unit unit;
    Listener listener;
    ASSERT_EQ(listener.take(unit.next()), DOTTRACK_FRESH);
    unit.sequence = static_cast<std::uint8_t>(ahead);
    EXPECT_EQ(listener.take(unit.next()), ahead <= 127 ? DOTTRACK_FRESH : DOTTRACK_STALE) << ahead;
  }
}

TEST(ReceiverGroup, WhatAnotherVersionSaysIsNotUsed) {
  for (const bool fd : {false, true}) {
    Unit unit;
    unit.shape.fd = fd;
    unit.shape.version = 3;
    Listener listener;
    std::uint64_t frames = 0;
    for (unsigned i = 0; i < 100; ++i) {
      const Frames sent = frames_of(unit.next());
      frames += sent.size();
      EXPECT_EQ(listener.push(sent, unit.arrival_us()), DOTTRACK_OTHER_VERSION);
    }
    EXPECT_EQ(listener.verdicts(DOTTRACK_OTHER_VERSION), frames);
    EXPECT_EQ(listener.counts().other_version, frames);
    EXPECT_EQ(listener.counts().incomplete, 0U);
    EXPECT_EQ(listener.counts().fresh, 0U);
  }
}

TEST(ReceiverGroup, TheLayoutMayChangeBetweenClassicAndFd) {
  Unit unit;
  Listener listener;
  for (unsigned i = 0; i < 200; ++i) {
    unit.shape.fd = i % 2 == 1;
    ASSERT_EQ(listener.take(i % 3 == 0 ? full_group(unit) : unit.next()), DOTTRACK_FRESH);
  }
  EXPECT_EQ(listener.counts().fresh, 200U);
}

TEST(ReceiverGroup, ExtendedIdentifiersAndAnotherBase) {
  dottrack_settings settings = dottrack_default_settings();
  settings.base_id = 0x1FFFFFC0;
  settings.extended = true;
  Listener listener(settings);
  Unit unit;
  Frames frames = frames_of(full_group(unit));
  EXPECT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_FOREIGN);
  for (dottrack_frame& frame : frames) {
    frame.id += 0x1FFFFFC0U - DOTTRACK_DEFAULT_BASE_ID;
    frame.extended = true;
  }
  EXPECT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_FRESH);
}

TEST(ReceiverGroup, IdentityAndRepliesBelongToNoGroup) {
  Unit unit;
  Listener listener;
  Frames frames = frames_of(unit.next());
  const dottrack_frame last = frames.back();
  frames.pop_back();
  ASSERT_EQ(listener.push(frames, unit.arrival_us()), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(version_frame(77, 2, {}, 333), unit.arrival_us()), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(configuration_frame(99, 1, 0, 4), unit.arrival_us()), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(reply_frame({}, 150), unit.arrival_us()), DOTTRACK_WAITING);
  EXPECT_EQ(listener.push(last, unit.arrival_us()), DOTTRACK_FRESH);
}

}  // namespace
}  // namespace dottrack::receiver_test
