// Long streams with faults: every one is found, and no wrong pose is ever given out as fresh.

#include <gtest/gtest.h>

#include "tests/unit/receiver/faulty_stream.h"

namespace dottrack::receiver_test {
namespace {

class ReceiverStream : public testing::TestWithParam<bool> {};

TEST_P(ReceiverStream, EveryFaultIsFoundAndCounted) {
  FaultyStream stream(GetParam() ? 11 : 12, GetParam());
  stream.run(20'000);
  const dottrack_counts& counts = stream.listener().counts();
  const dottrack_counts& expected = stream.expected();
  EXPECT_EQ(counts.fresh, expected.fresh);
  EXPECT_EQ(counts.stale, expected.stale);
  EXPECT_EQ(counts.repeated_groups, expected.repeated_groups);
  EXPECT_EQ(counts.incomplete, expected.incomplete);
  EXPECT_EQ(counts.lost_groups, expected.lost_groups);
  EXPECT_EQ(counts.corrupted, expected.corrupted);
  EXPECT_EQ(counts.repeated_frames, expected.repeated_frames);
  EXPECT_EQ(counts.late_frames, expected.late_frames);
  EXPECT_EQ(counts.other_version, 0U);
  EXPECT_EQ(counts.restarts, 0U);
  EXPECT_EQ(counts.silences, 0U);
  EXPECT_EQ(stream.wrong_poses(), 0U);
}

TEST_P(ReceiverStream, TheVerdictsSayTheSameAsTheCounts) {
  FaultyStream stream(13, GetParam());
  stream.run(5000);
  const Listener& listener = stream.listener();
  const dottrack_counts& counts = listener.counts();
  EXPECT_EQ(listener.verdicts(DOTTRACK_FRESH), counts.fresh);
  EXPECT_EQ(listener.verdicts(DOTTRACK_STALE), counts.stale + counts.late_frames);
  EXPECT_EQ(listener.verdicts(DOTTRACK_REPEATED), counts.repeated_groups + counts.repeated_frames);
  EXPECT_EQ(listener.verdicts(DOTTRACK_CORRUPTED), counts.corrupted);
  EXPECT_LE(listener.verdicts(DOTTRACK_INCOMPLETE), counts.incomplete);
}

TEST_P(ReceiverStream, EveryKindOfFaultWasPutIn) {
  FaultyStream stream(14, GetParam());
  stream.run(20'000);
  for (std::size_t fault = 0; fault < kFaults; ++fault) {
    EXPECT_GE(stream.injected()[fault], 1200U) << fault;
  }
  EXPECT_GE(stream.expected().fresh, 40'000U);
}

INSTANTIATE_TEST_SUITE_P(Buses, ReceiverStream, testing::Bool(),
                         [](const auto& bus) { return bus.param ? "Fd" : "Classic"; });

}  // namespace
}  // namespace dottrack::receiver_test
