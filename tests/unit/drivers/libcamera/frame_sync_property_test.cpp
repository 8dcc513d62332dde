// Cameras that run freely and badly, against what must hold whatever they do.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "drivers/libcamera/frame_sync.h"
#include "rtos_shim/allocation_trap/allocation_trap.h"

namespace dottrack::drivers {
namespace {

constexpr Duration kPeriod = std::chrono::microseconds(33'333);
constexpr int kTicks = 600;

// How the cameras behave. Times in periods.
struct Conduct {
  std::size_t cameras = 4;
  double drift = 0.0;     // of the cameras' rate against the ticks'
  double phase = 0.0;     // of the first exposure
  double jitter = 0.0;    // of a stamp, either way
  double latency = 0.2;   // from exposure to arrival, at least
  double spread = 0.0;    // and so much more at most
  double lost = 0.0;      // share of frames
  double overrun = 0.0;   // share of ticks that take three periods
  double deadline = 0.5;  // after the tick's instant
  bool triggered = false;
};

struct Sent {
  Time arrives{};
  std::size_t camera = 0;
  int exposure = 0;  // the same of all cameras for one instant
  Arrival frame;
};

struct Outcome {
  int complete = 0;
  int partial = 0;
  int empty = 0;
  int taken = 0;
  int late = 0;
  int waiting = 0;
  std::uint64_t heap_calls = 0;
};

Time in_periods(double periods) {
  return Time(std::chrono::seconds(1)) +
         Duration(static_cast<Duration::rep>(periods * static_cast<double>(kPeriod.count())));
}

class Run final : public LateFrames {
 public:
  Run(const Conduct& conduct, unsigned seed)
      : conduct_(conduct), random_(seed), sync_(kPeriod, conduct.triggered, *this) {}

  Outcome go() {
    send();
    double tick = 0.0;
    while (tick < kTicks) {
      do_tick(tick);
      const double busy = chance(conduct_.overrun) ? 3.0 : 1.0;
      tick += busy;
    }
    outcome_.waiting = static_cast<int>(next_) - outcome_.taken - outcome_.late;
    return outcome_;
  }

  void give_back_late(std::size_t camera, const Arrival& frame) override {
    ++outcome_.late;
    settle(camera, frame);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }

  // All frames of the run, in the order of their arrival. A triggered exposure begins at its tick.
  void send() {
    for (std::size_t camera = 0; camera < conduct_.cameras; ++camera) {
      double last_arrival = -1e9;
      for (int exposure = 0; exposure < kTicks; ++exposure) {
        if (chance(conduct_.lost)) continue;
        const double exposed = conduct_.phase + exposure * (1.0 + conduct_.drift);
        const double stamp = exposed + uniform(-conduct_.jitter, conduct_.jitter);
        last_arrival = std::max(last_arrival,
                                exposed + conduct_.latency + uniform(0.0, conduct_.spread) + 1e-6);
        sent_.push_back({.arrives = in_periods(last_arrival),
                         .camera = camera,
                         .exposure = exposure,
                         .frame = {.mid_exposure = in_periods(stamp),
                                   .sequence = static_cast<std::uint32_t>(exposure),
                                   .buffer = 0}});
      }
    }
    std::stable_sort(sent_.begin(), sent_.end(),
                     [](const Sent& a, const Sent& b) { return a.arrives < b.arrives; });
  }

  void add_until(Time now) {
    while (next_ < sent_.size() && sent_[next_].arrives <= now) add_next(now);
  }
  void add_next(Time now) {
    const Sent& sent = sent_[next_++];
    sync_.add(sent.camera, sent.frame, now);
  }

  void do_tick(double tick) {
    const CameraSet all = CameraSet::first(conduct_.cameras);
    Time now = in_periods(tick);
    const Time deadline = in_periods(tick + conduct_.deadline);
    const rtos::AllocationTrap::Scope armed;
    add_until(now);
    sync_.begin(now);
    while (!sync_.complete(all, all) && now < deadline) {
      now = next_ < sent_.size() ? std::min(deadline, sent_[next_].arrives) : deadline;
      add_until(now);
    }
    const CameraSet taken = sync_.take(all, all, now);
    outcome_.heap_calls += armed.calls().total();
    judge(taken, all);
  }

  void judge(CameraSet taken, CameraSet all) {
    ++(taken == all ? outcome_.complete : taken.empty() ? outcome_.empty : outcome_.partial);
    std::set<std::uint32_t> exposures;
    for (std::size_t camera = 0; camera < conduct_.cameras; ++camera) {
      if (!taken.contains(camera)) continue;
      ++outcome_.taken;
      exposures.insert(sync_.taken(camera).sequence);
      settle(camera, sync_.taken(camera));
    }
    if (taken.empty()) return;
    ASSERT_EQ(exposures.size(), 1U) << "a set mixes exposures";
    ASSERT_GT(static_cast<int>(*exposures.begin()), last_) << "a set is not newer than the last";
    last_ = static_cast<int>(*exposures.begin());
  }

  // A frame is taken or given back, and that once.
  void settle(std::size_t camera, const Arrival& frame) {
    const std::size_t place = camera * kTicks + frame.sequence;
    EXPECT_FALSE(settled_[place]) << "camera " << camera << ", exposure " << frame.sequence;
    settled_[place] = true;
  }

  Conduct conduct_;
  std::mt19937 random_;
  FrameSync sync_;
  std::vector<Sent> sent_;
  std::size_t next_ = 0;
  int last_ = -1;
  std::vector<bool> settled_ = std::vector<bool>(kMaxCameras * kTicks);
  Outcome outcome_;
};

Outcome run(const Conduct& conduct, unsigned seed = 1) {
  const Outcome outcome = Run(conduct, seed).go();
  EXPECT_EQ(outcome.heap_calls, 0U);
  EXPECT_GE(outcome.waiting, 0);
  EXPECT_LE(outcome.waiting, static_cast<int>(conduct.cameras * FrameSync::kMaxWaiting));
  return outcome;
}

TEST(FreeRunningCameras, OfTheTicksRateFillEveryTickInEveryPhase) {
  for (int phase = 0; phase < 20; ++phase) {
    const Outcome outcome = run({.phase = phase / 20.0, .jitter = 0.02, .spread = 0.05});
    EXPECT_GE(outcome.complete, kTicks - 3) << phase;
    EXPECT_EQ(outcome.partial, 0) << phase;
  }
}

TEST(FreeRunningCameras, ThatDriftCostATickOnlyWhenTheySlipAWholePeriod) {
  for (const double drift : {-0.01, -0.001, 0.001, 0.01}) {
    const Outcome outcome = run({.drift = drift, .jitter = 0.01, .spread = 0.03});
    const int slips = static_cast<int>(std::abs(drift) * kTicks) + 1;
    EXPECT_GE(outcome.complete, kTicks - 3 * slips - 3) << drift;
    EXPECT_EQ(outcome.partial, 0) << drift;
  }
}

TEST(FreeRunningCameras, ThatLoseFramesCostThoseFramesAndLittleElse) {
  const Outcome outcome = run({.cameras = 8, .phase = 0.05, .spread = 0.05, .lost = 0.02});
  EXPECT_LE(outcome.empty, kTicks / 20);
  EXPECT_GE(outcome.taken, 8 * kTicks * 90 / 100);
}

TEST(FreeRunningCameras, WhoseTicksOverrunGetTheNewestGroupAtOnce) {
  const Outcome outcome = run({.phase = 0.3, .spread = 0.05, .overrun = 0.1});
  EXPECT_EQ(outcome.partial, 0);
  EXPECT_LE(outcome.empty, 3);
}

TEST(TriggeredCameras, FillEveryTick) {
  const Outcome outcome = run({.phase = 0.05, .jitter = 0.02, .spread = 0.1, .triggered = true});
  EXPECT_EQ(outcome.complete, kTicks);
}

TEST(TriggeredCameras, ThatAreLateCostNoOtherTick) {
  // A frame in five comes after the deadline.
  const Outcome outcome =
      run({.cameras = 1, .phase = 0.05, .latency = 0.05, .spread = 0.5, .triggered = true});
  EXPECT_GT(outcome.complete, kTicks / 2);
  EXPECT_EQ(outcome.complete + outcome.empty, kTicks);
  EXPECT_EQ(outcome.late + outcome.waiting, outcome.empty);
}

// Whatever they do: no set mixes exposures, none is older than the one before, every frame is taken
// or given back once, and the heap is left alone.
TEST(AnyCameras, KeepThePromises) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (unsigned seed = 0; seed < 150; ++seed) {
    Conduct conduct;
    conduct.cameras = 1 + random() % kMaxCameras;
    conduct.drift = uniform(-0.05, 0.05);
    conduct.phase = uniform(0.0, 1.0);
    conduct.jitter = uniform(0.0, 0.2);
    conduct.latency = uniform(0.0, 1.5) + conduct.jitter;
    conduct.spread = uniform(0.0, 1.5);
    conduct.lost = seed % 3 == 0 ? 0.0 : uniform(0.0, 0.5);
    conduct.overrun = seed % 2 == 0 ? 0.0 : uniform(0.0, 0.3);
    conduct.deadline = uniform(0.0, 0.95);
    SCOPED_TRACE(seed);
    const Outcome outcome = run(conduct, seed);
    if (testing::Test::HasFailure()) return;
    EXPECT_GT(outcome.complete + outcome.partial + outcome.empty, 0);
  }
}

}  // namespace
}  // namespace dottrack::drivers
