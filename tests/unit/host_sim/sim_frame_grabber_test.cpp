#include "host_sim/hal/sim_frame_grabber.h"

#include <gtest/gtest.h>

#include <memory>

namespace dottrack::host_sim {
namespace {

using std::chrono::milliseconds;

constexpr int kWidth_px = 6;
constexpr int kHeight_px = 40;
constexpr CameraSet kAll = CameraSet::first(2);

// A grabber of two cameras whose pictures are all of the number of their tick plus 1.
class SimGrabber : public testing::Test {
 protected:
  void make(SimGrabberSetup setup, const IrisModel& iris = {}) {
    setup.cameras = {{0.004, 1.0, 0.0}, {0.008, 2.0, 0.010}};
    iris_ = std::make_unique<SimIris>(2, iris, clock_);
    const auto paint = [this](std::span<const Exposure> exposures, std::vector<GreyImage>& images) {
      exposures_.assign(exposures.begin(), exposures.end());
      for (std::size_t i = 0; i < images.size(); ++i) {
        const auto grey = static_cast<std::uint8_t>(exposures[i].noise.tick + 1);
        images[i] = GreyImage(kWidth_px, kHeight_px, grey);
      }
    };
    grabber_ = std::make_unique<SimFrameGrabber>(setup, paint, *iris_, clock_);
  }

  // Ticks are 100 ms apart, the deadline after 50.
  const hal::FrameSet& tick() {
    const Time due(milliseconds(100) * tick_++);
    clock_.jump_to(due);
    grabber_->prepare(due);
    grabber_->trigger(clock_.now());
    const hal::FrameSet& set = grabber_->await(kAll, due + milliseconds(50));
    grabber_->release();
    delivered_ = grabber_->delivered();
    return set;
  }

  rtos::VirtualClock clock_;
  std::unique_ptr<SimIris> iris_;
  std::unique_ptr<SimFrameGrabber> grabber_;
  std::vector<Exposure> exposures_;
  CameraSet delivered_;
  int tick_ = 0;
};

TEST_F(SimGrabber, FramesAreThereAfterExposureReadOutAndLatency) {
  make({.model = {.latency_s = 0.010, .jitter_s = 0.0}});
  tick();
  const hal::FrameSet& set = tick();
  EXPECT_EQ(delivered_, kAll);
  EXPECT_EQ(set.frames[0].mid_exposure, Time(milliseconds(100)));
  EXPECT_EQ(grabber_->arrival(0), Time(milliseconds(112)));
  EXPECT_EQ(grabber_->arrival(1), Time(milliseconds(119)));
  EXPECT_EQ(clock_.now(), grabber_->arrival(1)) << "the last one is waited for";
  EXPECT_EQ(grabber_->picture(1).at(2, 2), 2);
  EXPECT_DOUBLE_EQ(exposures_[1].middle_s, 0.1);
  EXPECT_EQ(exposures_[1].gain, 2.0);
}

TEST_F(SimGrabber, TheJitterIsWithinItsBoundsAndTheSameOnEveryRun) {
  std::vector<Time> arrivals;
  for (int run = 0; run < 2; ++run) {
    tick_ = 0;
    make({.model = {.latency_s = 0.010, .jitter_s = 0.002}, .seed = 9});
    bool varies = false;
    for (int i = 0; i < 20; ++i) {
      tick();
      const auto late = grabber_->arrival(0) - grabber_->mid_exposure(0) - milliseconds(12);
      EXPECT_GE(late, Duration(0));
      EXPECT_LT(late, milliseconds(2));
      varies = varies || late > milliseconds(1);
      if (run == 0) arrivals.push_back(grabber_->arrival(0));
      EXPECT_EQ(grabber_->arrival(0), arrivals[static_cast<std::size_t>(i)]);
    }
    EXPECT_TRUE(varies);
  }
}

TEST_F(SimGrabber, ADeadCameraIsWaitedForUntilTheDeadlineAndComesBack) {
  make({.faults = {{0, CameraFaultKind::dead, 0.1, 0.3}}});
  std::uint32_t sequence = 0;
  for (const bool alive : {true, false, false, true}) {
    const hal::FrameSet& set = tick();
    EXPECT_EQ(delivered_.contains(0), alive);
    EXPECT_TRUE(delivered_.contains(1));
    const Time deadline = Time(milliseconds(100) * (tick_ - 1) + milliseconds(50));
    EXPECT_EQ(clock_.now() == deadline, !alive);
    EXPECT_EQ(set.frames[0].sequence, ++sequence);
  }
  EXPECT_EQ(grabber_->counts().dead, 2U);
  EXPECT_EQ(grabber_->counts().triggered, 8U);
  EXPECT_EQ(grabber_->counts().delivered, 6U);
}

TEST_F(SimGrabber, AStuckCameraShowsItsLastPictureWithNewNumbers) {
  make({.faults = {{0, CameraFaultKind::stuck, 0.2, 0.4}}});
  std::vector<int> greys;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(tick().frames[0].sequence, static_cast<std::uint32_t>(i + 1));
    greys.push_back(grabber_->picture(0).at(0, 0));
  }
  EXPECT_EQ(greys, (std::vector<int>{1, 2, 2, 2, 5}));
}

TEST_F(SimGrabber, ATornPictureEndsWithTheOneBefore) {
  make({.faults = {{1, CameraFaultKind::torn, 0.2, 0.3}}});
  tick();
  tick();
  tick();
  EXPECT_EQ(grabber_->picture(1).at(3, 0), 3);
  EXPECT_EQ(grabber_->picture(1).at(3, kHeight_px - 1), 2);
  tick();
  EXPECT_EQ(grabber_->picture(1).at(3, kHeight_px - 1), 4);
}

TEST_F(SimGrabber, ALateFrameIsCountedAndNeverDelivered) {
  make({.faults = {{0, CameraFaultKind::late, 0.0, 0.2}}});
  tick();
  EXPECT_EQ(delivered_, CameraSet(0b10));
  tick();
  tick();
  EXPECT_EQ(delivered_, kAll);
  EXPECT_EQ(grabber_->counts().late, 2U);
}

TEST_F(SimGrabber, FramesAreDroppedAsOftenAsTheModelSays) {
  make({.model = {.drop_share = 0.2}});
  for (int i = 0; i < 500; ++i) tick();
  EXPECT_NEAR(static_cast<double>(grabber_->counts().dropped), 200.0, 45.0);
}

TEST_F(SimGrabber, SettingsTakeEffectTwoTicksLater) {
  make({});
  tick();
  ASSERT_TRUE(grabber_->set_exposure(0, {milliseconds(2), 3.0}));
  tick();
  ASSERT_TRUE(grabber_->set_exposure(0, {milliseconds(1), 4.0}));
  EXPECT_DOUBLE_EQ(exposures_[0].duration_s, 0.004);
  tick();
  EXPECT_DOUBLE_EQ(exposures_[0].duration_s, 0.002);
  EXPECT_EQ(exposures_[0].gain, 3.0);
  tick();
  EXPECT_DOUBLE_EQ(exposures_[0].duration_s, 0.001);
  EXPECT_EQ(grabber_->exposure(0).gain, 4.0);
  EXPECT_EQ(exposures_[1].gain, 2.0);
}

TEST_F(SimGrabber, SettingsThatCannotBeAreRefused) {
  make({});
  EXPECT_FALSE(grabber_->set_exposure(2, {milliseconds(2), 1.0}));
  EXPECT_FALSE(grabber_->set_exposure(0, {Duration(0), 1.0}));
  EXPECT_FALSE(grabber_->set_exposure(0, {milliseconds(2), 0.0}));
  EXPECT_FALSE(grabber_->set_exposure(0, {std::chrono::seconds(2), 1.0}));
}

TEST_F(SimGrabber, TheIrisIsInTheExposure) {
  make({}, {.opening = 0.5, .drift_per_s = 0.2});
  tick();
  EXPECT_DOUBLE_EQ(exposures_[0].opening, 0.5);
  for (int i = 0; i < 10; ++i) tick();
  EXPECT_NEAR(exposures_[0].opening, 0.6, 1e-12);
}

}  // namespace
}  // namespace dottrack::host_sim
