#include "host_sim/hal/sim_frame_grabber.h"

#include <array>

#include "tests/contract/frame_grabber_contract.h"

namespace dottrack::test {
namespace {

// Grey pictures at once, whatever the exposure.
void paint(std::span<const host_sim::Exposure> exposures,
           std::vector<host_sim::GreyImage>& images) {
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    images[i] = host_sim::GreyImage(GrabberBench::kWidth_px, GrabberBench::kHeight_px, 90);
  }
}

// One tick a second for every set of cameras that can be asked for: in second n those whose bits
// are not set in n are dead.
class SimulatedBench final : public GrabberBench {
 public:
  hal::FrameGrabber& grabber() override { return grabber_; }
  Time now() const override { return clock_.now(); }
  void prepare(CameraSet delivering) override {
    const auto second = static_cast<std::int64_t>(delivering.bits()) + kSets * ++round_;
    clock_.jump_to(Time(std::chrono::seconds(second)));
    grabber_.prepare(clock_.now());
  }

 private:
  static constexpr std::int64_t kSets = 1 << kCameras;
  static constexpr std::int64_t kRounds = 8;

  static host_sim::SimGrabberSetup setup() {
    host_sim::SimGrabberSetup setup;
    setup.cameras.resize(kCameras);
    for (std::int64_t second = 0; second < kSets * kRounds; ++second) {
      const CameraSet delivering(static_cast<std::uint16_t>(second % kSets));
      for (std::size_t camera = 0; camera < kCameras; ++camera) {
        if (delivering.contains(camera)) continue;
        const auto at_s = static_cast<double>(second);
        setup.faults.push_back({camera, host_sim::CameraFaultKind::dead, at_s - 0.1, at_s + 0.1});
      }
    }
    return setup;
  }

  rtos::VirtualClock clock_;
  host_sim::SimIris iris_{kCameras, {}, clock_};
  host_sim::SimFrameGrabber grabber_{setup(), paint, iris_, clock_};
  std::int64_t round_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Simulated, FrameGrabberContract,
                         testing::Values(GrabberCase{
                             "grabber", [] { return std::make_unique<SimulatedBench>(); }}));

}  // namespace
}  // namespace dottrack::test
