#include "drivers/recorded/recorded_frame_grabber.h"

#include <stdexcept>

#include "tests/contract/frame_grabber_contract.h"
#include "tests/support/disc_scene.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::test {
namespace {

// One recorded tick for every set of cameras that can be asked for: tick n has images of the
// cameras whose bits are set in n.
class RecordedBench final : public GrabberBench {
 public:
  RecordedBench() {
    const std::string pgm = flat_image(kWidth_px, kHeight_px, 90).pgm();
    std::vector<drivers::RecordedCamera> cameras;
    for (std::size_t camera = 0; camera < kCameras; ++camera) {
      cameras.push_back({DiscScene::camera_name(camera), kWidth_px, kHeight_px});
      for (std::uint16_t tick = 0; tick < 1U << kCameras; ++tick) {
        if (!CameraSet(tick).contains(camera)) continue;
        write_bytes(frame_path(folder_.path(), camera, tick), pgm);
      }
    }
    auto opened = drivers::RecordedFrameGrabber::open(folder_.path(), cameras);
    if (!opened) throw std::runtime_error(opened.error().message);
    grabber_ = std::move(*opened);
  }

  hal::FrameGrabber& grabber() override { return *grabber_; }
  Time now() const override { return Time(std::chrono::seconds(7)); }
  void prepare(CameraSet delivering) override { grabber_->load(delivering.bits()); }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<drivers::RecordedFrameGrabber> grabber_;
};

INSTANTIATE_TEST_SUITE_P(Recorded, FrameGrabberContract,
                         testing::Values(GrabberCase{
                             "grabber", [] { return std::make_unique<RecordedBench>(); }}));

}  // namespace
}  // namespace dottrack::test
