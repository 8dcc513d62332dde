#include "app/workstation/monitor/monitor.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "app/workstation/monitor_command.h"
#include "tests/unit/workstation/monitor/sent_groups.h"

namespace dottrack::monitor {
namespace {

using testing::Each;
using testing::ElementsAre;
using workstation::monitor_exit_status;

class Given final : public FrameSource {
 public:
  explicit Given(std::vector<Arrival> arrivals) : arrivals_(std::move(arrivals)) {}

 private:
  Got do_next(Arrival& arrival) override {
    if (next_ == arrivals_.size()) return Got::end;
    arrival = arrivals_[next_++];
    return Got::frame;
  }

  std::vector<Arrival> arrivals_;
  std::size_t next_ = 0;
};

struct Seen {
  std::vector<std::string> verdicts;
  std::vector<dottrack_pose> poses;  // fresh and valid
  std::vector<std::uint64_t> lost;
  std::size_t frames = 0;
  bool finished = false;
};

class Remember final : public Writer {
 public:
  explicit Remember(Seen& seen) : seen_(seen) {}

 private:
  void do_frame(const Arrival&) override { ++seen_.frames; }
  void do_report(const Report& report, const Overview&) override {
    seen_.verdicts.emplace_back(dottrack_verdict_text(report.verdict));
    seen_.lost.push_back(report.groups_lost);
    if (is_fresh_pose(report)) seen_.poses.push_back(*report.pose);
  }
  Result<void> do_finish(const Overview&) override {
    seen_.finished = true;
    return {};
  }

  Seen& seen_;
};

class MonitorTest : public testing::Test {
 protected:
  void run(std::vector<Arrival> arrivals, const MonitorLimits& limits = {}) {
    Given source(std::move(arrivals));
    monitor_.run(source, limits, [] { return true; });
    ASSERT_TRUE(monitor_.finish(0));
  }
  int exit_status(bool strict) const {
    return monitor_exit_status(monitor_.statistics(), monitor_.counts(), strict);
  }
  static std::vector<std::unique_ptr<Writer>> writers(Seen& seen) {
    std::vector<std::unique_ptr<Writer>> all;
    all.push_back(std::make_unique<Remember>(seen));
    return all;
  }

  Seen seen_;
  Monitor monitor_{dottrack_default_settings(), writers(seen_)};
};

TEST_F(MonitorTest, EveryGroupThatComesWholeIsFresh) {
  constexpr unsigned kGroups = 90;
  std::vector<Arrival> arrivals = test::groups(kGroups);
  const std::size_t frames = arrivals.size();
  test::append(arrivals, test::identity(kGroups));
  run(arrivals);
  EXPECT_EQ(seen_.verdicts.size(), kGroups);
  EXPECT_THAT(seen_.verdicts, Each("fresh"));
  ASSERT_EQ(seen_.poses.size(), kGroups);
  for (unsigned n = 0; n < kGroups; ++n) {
    EXPECT_NEAR(seen_.poses[n].position_m[0], 1.0 + 0.01 * n, 0.00006);
  }
  EXPECT_EQ(seen_.frames, frames + 2);
  EXPECT_TRUE(seen_.finished);
  const Statistics& statistics = monitor_.statistics();
  EXPECT_EQ(statistics.fresh_poses(), kGroups);
  EXPECT_NEAR(statistics.groups_per_s(), 30.3, 0.5);
  EXPECT_NEAR(statistics.mean_age_s(), 0.012, 0.0002);
  EXPECT_NEAR(statistics.rms_jitter_s(), 0.0, 1e-6);
  EXPECT_EQ(share_lost(monitor_.counts()), 0.0);
  EXPECT_EQ(monitor_.unit().config_hash, 0x1A2B3C4DU);
  EXPECT_EQ(exit_status(false), 0);
  EXPECT_EQ(exit_status(true), 0);
}

TEST_F(MonitorTest, CountsWhatIsLostAndSaysSo) {
  std::vector<Arrival> arrivals;
  constexpr unsigned kGroups = 100;
  unsigned incomplete = 0;
  unsigned lost = 0;
  for (unsigned n = 0; n < kGroups; ++n) {
    std::vector<Arrival> group = test::frames_of(n);
    if (n % 20 == 5) {
      ++lost;
      continue;
    }
    if (n % 10 == 7) {
      group.erase(group.begin() + 3);
      ++incomplete;
    }
    test::append(arrivals, group);
  }
  run(arrivals);
  const dottrack_counts& counts = monitor_.counts();
  EXPECT_EQ(counts.incomplete, incomplete);
  EXPECT_EQ(counts.lost_groups, lost);
  EXPECT_EQ(counts.fresh, kGroups - incomplete - lost);
  EXPECT_EQ(std::count(seen_.verdicts.begin(), seen_.verdicts.end(), "incomplete"), incomplete);
  EXPECT_EQ(std::count(seen_.lost.begin(), seen_.lost.end(), 1U), lost);
  EXPECT_DOUBLE_EQ(share_lost(counts), 0.15);
  EXPECT_EQ(exit_status(false), 0);
  EXPECT_EQ(exit_status(true), 1);
}

TEST_F(MonitorTest, TellsDamagedRepeatedAndOldGroupsApart) {
  std::vector<Arrival> arrivals = test::groups(2);
  std::vector<Arrival> damaged = test::frames_of(2);
  damaged[4].frame.data[5] ^= 0x10;
  test::append(arrivals, damaged);
  test::append(arrivals, test::frames_of(3));
  std::vector<Arrival> again = test::frames_of(3);
  again.resize(1);
  test::append(arrivals, again);
  protocol::PoseMessage old = test::message_of(4);
  old.age = std::chrono::milliseconds(800);
  old.mid_exposure -= std::chrono::milliseconds(20);
  test::append(arrivals, test::frames_of(4, old));
  run(arrivals);
  EXPECT_THAT(seen_.verdicts, ElementsAre("fresh", "fresh", "corrupted", "incomplete", "fresh",
                                          "repeated", "stale"));
  EXPECT_EQ(exit_status(false), 0);
  EXPECT_EQ(exit_status(true), 1);
}

TEST_F(MonitorTest, SilenceIsToldOnce) {
  std::vector<Arrival> arrivals = test::groups(3);
  // Identity frames alone keep the bus busy, but there is no pose.
  for (unsigned n = 3; n < 60; ++n) test::append(arrivals, test::identity(n));
  run(arrivals);
  EXPECT_THAT(seen_.verdicts, ElementsAre("fresh", "fresh", "fresh", "stale"));
  EXPECT_EQ(monitor_.statistics().silences(), 1U);
}

TEST_F(MonitorTest, WithoutAPoseThereIsNothingToGoBy) {
  protocol::PoseMessage none;
  none.reason = core::Reason::too_few_regions;
  none.age = test::kAge;
  std::vector<Arrival> arrivals;
  for (unsigned n = 0; n < 10; ++n) {
    none.mid_exposure = test::message_of(n).mid_exposure;
    test::append(arrivals, test::frames_of(n, none));
  }
  run(arrivals);
  EXPECT_EQ(seen_.verdicts.size(), 10U);
  EXPECT_THAT(seen_.verdicts, Each("fresh"));
  EXPECT_TRUE(seen_.poses.empty());
  EXPECT_EQ(exit_status(false), 1);
}

TEST_F(MonitorTest, EndsAfterSoManyPoses) {
  MonitorLimits limits;
  limits.poses = 4;
  run(test::groups(20), limits);
  EXPECT_EQ(seen_.poses.size(), 4U);
}

TEST_F(MonitorTest, EndsAfterSoLong) {
  MonitorLimits limits;
  limits.duration = 5 * test::kPeriod;
  run(test::groups(20), limits);
  EXPECT_EQ(seen_.poses.size(), 6U);
}

TEST_F(MonitorTest, AGroupInOneFdFrameIsAGroupToo) {
  run(test::groups(10, {.fd = true}));
  EXPECT_EQ(seen_.poses.size(), 10U);
  EXPECT_TRUE(seen_.poses.front().has_covariance);
}

TEST(RateMeterTest, CountsTheLastSeconds) {
  RateMeter meter;
  const Duration start = std::chrono::seconds(1700000000);
  EXPECT_EQ(meter.per_second(start), 0.0);
  Duration now = start;
  for (int i = 0; i < 500; ++i, now += std::chrono::milliseconds(10)) meter.count(now);
  EXPECT_NEAR(meter.per_second(now), 100.0, 1e-9);
  EXPECT_EQ(meter.per_second(now + std::chrono::seconds(10)), 0.0);
}

}  // namespace
}  // namespace dottrack::monitor
