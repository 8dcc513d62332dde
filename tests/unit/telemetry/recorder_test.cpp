#include "app/telemetry/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace dottrack::telemetry {
namespace {

using testing::ElementsAre;

class Keep final : public RecordWriter {
 public:
  std::vector<std::uint64_t> ticks;

 private:
  void do_write(const CycleRecord& record) override { ticks.push_back(record.result.tick); }
};

CycleRecord record_of(std::uint64_t tick) {
  CycleRecord record;
  record.result.tick = tick;
  return record;
}

TEST(Recorder, HandsEveryRecordToEveryWriterInOrder) {
  const auto ring = std::make_unique<RecordRing>();
  Recorder recorder(*ring);
  Keep first;
  Keep second;
  recorder.add(first);
  recorder.add(second);
  for (std::uint64_t tick = 3; tick < 6; ++tick) ASSERT_TRUE(ring->try_push(record_of(tick)));
  EXPECT_EQ(recorder.drain(), 3U);
  EXPECT_THAT(first.ticks, ElementsAre(3, 4, 5));
  EXPECT_THAT(second.ticks, ElementsAre(3, 4, 5));
}

TEST(Recorder, AnEmptyRingIsNothingToDo) {
  const auto ring = std::make_unique<RecordRing>();
  Recorder recorder(*ring);
  Keep writer;
  recorder.add(writer);
  EXPECT_EQ(recorder.drain(), 0U);
  EXPECT_TRUE(writer.ticks.empty());
}

TEST(StageTimes, TheCycleIsTheSumOfItsStages) {
  const StageTimes times{Duration(1), Duration(20), Duration(300), Duration(4000), Duration(50000)};
  EXPECT_EQ(times.cycle(), Duration(54321));
}

}  // namespace
}  // namespace dottrack::telemetry
