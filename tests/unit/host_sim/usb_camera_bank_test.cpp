// The cameras as a guest sees them, over real sockets.

#include "host_sim/usb_cameras/usb_camera_bank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <thread>

#include "tests/support/temporary_folder.h"
#include "tests/unit/host_sim/redir_guest.h"

namespace dottrack::host_sim {
namespace {

using test::RedirGuest;
using testing::HasSubstr;
using Bytes = RedirGuest::Bytes;

// Tells camera, barrier, exposure in 100 us and gain in 1/100 in its first bytes.
struct Label {
  std::uint8_t camera = 0;
  std::uint16_t barrier = 0;
  std::uint8_t exposure = 0;
  std::uint16_t gain = 0;
};

Bytes picture(const Label& label, std::size_t pixels) {
  Bytes bytes(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    bytes[i] = static_cast<std::uint8_t>(i * 13 + i / 251 + label.barrier * 3U + label.camera);
  }
  const std::array<std::uint8_t, 6> head{label.camera,
                                         static_cast<std::uint8_t>(label.barrier),
                                         static_cast<std::uint8_t>(label.barrier >> 8U),
                                         label.exposure,
                                         static_cast<std::uint8_t>(label.gain),
                                         static_cast<std::uint8_t>(label.gain >> 8U)};
  std::copy(head.begin(), head.end(), bytes.begin());
  return bytes;
}

Label label_of(const Bytes& frame) {
  return {frame[0], static_cast<std::uint16_t>(frame[1] | frame[2] << 8U), frame[3],
          static_cast<std::uint16_t>(frame[4] | frame[5] << 8U)};
}

testing::AssertionResult is_whole(const Bytes& frame, std::size_t pixels) {
  if (frame.size() != pixels) return testing::AssertionFailure() << frame.size() << " bytes";
  if (frame != picture(label_of(frame), pixels)) return testing::AssertionFailure() << "mixed up";
  return testing::AssertionSuccess();
}

class UsbCameraBankTest : public testing::Test {
 protected:
  void open(std::size_t cameras, int width_px = 64, int height_px = 48) {
    UsbCameraSetup setup;
    setup.folder = folder_.path();
    for (std::size_t i = 0; i < cameras; ++i) setup.names.push_back("cam" + std::to_string(i + 1));
    setup.width_px = width_px;
    setup.height_px = height_px;
    setup.frame_rate_hz = kRate_hz;
    pixels_ = static_cast<std::size_t>(width_px * height_px);
    auto bank =
        UsbCameraBank::open(setup, [this, width_px, height_px](std::span<const Exposure> exposures,
                                                               std::vector<GreyImage>& images) {
          render(exposures, width_px, height_px, images);
        });
    ASSERT_TRUE(bank) << bank.error().message;
    bank_ = std::move(*bank);
  }

  void render(std::span<const Exposure> exposures, int width_px, int height_px,
              std::vector<GreyImage>& images) {
    while (held_) std::this_thread::yield();
    for (const Exposure& exposure : exposures) {
      EXPECT_DOUBLE_EQ(exposure.middle_s, static_cast<double>(exposure.noise.tick) / kRate_hz);
      const Bytes bytes =
          picture({static_cast<std::uint8_t>(exposure.noise.camera),
                   static_cast<std::uint16_t>(exposure.noise.tick),
                   static_cast<std::uint8_t>(std::lround(exposure.duration_s * 1e4)),
                   static_cast<std::uint16_t>(std::lround(exposure.gain * 100))},
                  pixels_);
      GreyImage& image = images.emplace_back(width_px, height_px);
      for (int i = 0; i < width_px * height_px; ++i) {
        image.at(i % width_px, i / width_px) = bytes[static_cast<std::size_t>(i)];
      }
    }
  }

  std::unique_ptr<RedirGuest> plug(std::size_t camera) {
    auto guest = std::make_unique<RedirGuest>(folder_.path() / ("cam" + std::to_string(camera)));
    EXPECT_TRUE(guest->pump_until([&] { return guest->has_device(); }));
    EXPECT_TRUE(guest->set_configuration(1));
    return guest;
  }

  void TearDown() override { held_ = false; }

  static constexpr double kRate_hz = 100.0;
  test::TemporaryFolder folder_;
  std::size_t pixels_ = 0;
  std::atomic<bool> held_ = false;  // rendering waits
  std::unique_ptr<UsbCameraBank> bank_;
};

TEST_F(UsbCameraBankTest, AGuestGetsTheBytesOfEveryBarrier) {
  open(1);
  bank_->start();
  const auto guest = plug(0);
  const auto name = guest->control(0x80, 6, 0x0303, 0x0409, 255);
  ASSERT_TRUE(name);
  EXPECT_EQ(name->at(2), 'c');
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return guest->frames().size() >= 5; }));
  EXPECT_TRUE(bank_->streaming(0));
  EXPECT_GE(bank_->frames_sent(0), 4U);
  const std::vector<Barrier> barriers = bank_->barriers();
  int before = -1;
  for (const Bytes& frame : guest->frames()) {
    ASSERT_TRUE(is_whole(frame, pixels_));
    const int barrier = label_of(frame).barrier;
    EXPECT_GT(barrier, before);
    before = barrier;
    ASSERT_LT(static_cast<std::size_t>(barrier), barriers.size());
  }
  for (std::size_t k = 0; k < barriers.size(); ++k) {
    EXPECT_EQ(barriers[k].index, k);
    EXPECT_DOUBLE_EQ(barriers[k].scene_time_s, static_cast<double>(k) / kRate_hz);
    if (k > 0) {
      EXPECT_GT(barriers[k].released, barriers[k - 1].released);
    }
  }
}

TEST_F(UsbCameraBankTest, TheSceneWaitsForACameraThatStreams) {
  open(1);
  bank_->start();
  const auto guest = plug(0);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(bank_->barriers().empty());
  EXPECT_FALSE(bank_->streaming(0));
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  EXPECT_EQ(label_of(guest->frames().front()).barrier, 0);
}

TEST_F(UsbCameraBankTest, NothingIsSentBeforeTheStartNorAfterTheStop) {
  open(1);
  const auto guest = plug(0);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return bank_->streaming(0); }));
  EXPECT_TRUE(bank_->barriers().empty());
  bank_->start();
  ASSERT_TRUE(guest->pump_until([&] { return guest->frames().size() >= 2; }));
  bank_->stop();
  std::size_t before = 0;
  int looks = 0;
  do {
    ASSERT_LT(++looks, 100) << "barriers go on";
    before = bank_->barriers().size();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  } while (bank_->barriers().size() != before);
  bank_->start();
  EXPECT_TRUE(guest->pump_until([&] { return bank_->barriers().size() > before; }));
}

TEST_F(UsbCameraBankTest, WhatTheGuestSetsActsOnThePicture) {
  open(2);
  bank_->start();
  const auto guest = plug(0);
  const auto other = plug(1);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  EXPECT_EQ(label_of(guest->frames().front()).exposure, 40);
  EXPECT_EQ(label_of(guest->frames().front()).gain, 100);
  ASSERT_TRUE(guest->set_exposure(25, 250));
  ASSERT_TRUE(guest->pump_until([&] { return label_of(guest->frames().back()).gain == 250; }));
  EXPECT_EQ(label_of(guest->frames().back()).exposure, 25);
  EXPECT_EQ(bank_->exposure(0).exposure, std::chrono::microseconds(2500));
  EXPECT_DOUBLE_EQ(bank_->exposure(0).gain, 2.5);
  EXPECT_DOUBLE_EQ(bank_->exposure(1).gain, 1.0) << "another camera's";
}

TEST_F(UsbCameraBankTest, OneBarrierIsOneInstantForAllCameras) {
  open(3);
  bank_->start();
  std::vector<std::unique_ptr<RedirGuest>> guests;
  std::vector<RedirGuest*> all;
  for (std::size_t i = 0; i < 3; ++i) {
    guests.push_back(plug(i));
    all.push_back(guests.back().get());
    ASSERT_TRUE(all.back()->begin_stream());
  }
  const auto enough = [&] {
    return std::all_of(all.begin(), all.end(),
                       [](const RedirGuest* guest) { return guest->frames().size() >= 10; });
  };
  ASSERT_TRUE(test::pump_all(all, enough));
  std::array<std::vector<int>, 3> seen;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const Bytes& frame : all[i]->frames()) {
      ASSERT_TRUE(is_whole(frame, pixels_));
      ASSERT_EQ(label_of(frame).camera, i);
      seen[i].push_back(label_of(frame).barrier);
    }
    EXPECT_TRUE(std::is_sorted(seen[i].begin(), seen[i].end()));
  }
  const auto together = std::count_if(seen[0].begin(), seen[0].end(), [&](int barrier) {
    return std::count(seen[1].begin(), seen[1].end(), barrier) == 1 &&
           std::count(seen[2].begin(), seen[2].end(), barrier) == 1;
  });
  EXPECT_GE(together, 1);
}

TEST_F(UsbCameraBankTest, ACameraIsUnpluggedAndPluggedInAgain) {
  open(1);
  bank_->start();
  const auto guest = plug(0);
  ASSERT_TRUE(guest->set_exposure(25, 250));
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  bank_->unplug(0);
  ASSERT_TRUE(guest->pump_until([&] { return guest->disconnects() == 1; }));
  EXPECT_FALSE(guest->has_device());
  ASSERT_TRUE(guest->pump_until([&] { return !bank_->streaming(0); }));
  bank_->plug_in(0);
  ASSERT_TRUE(guest->pump_until([&] { return guest->has_device(); }));
  ASSERT_TRUE(guest->set_configuration(1));
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return guest->frames().size() >= 3; }));
  EXPECT_TRUE(is_whole(guest->frames().back(), pixels_));
  EXPECT_EQ(label_of(guest->frames().back()).exposure, 40) << "as new";
}

TEST_F(UsbCameraBankTest, ACameraThatIsUnpluggedIsNotAnnounced) {
  open(1);
  bank_->unplug(0);
  RedirGuest guest(folder_.path() / "cam0");
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(guest.pump());
  EXPECT_FALSE(guest.has_device());
  bank_->plug_in(0);
  EXPECT_TRUE(guest.pump_until([&] { return guest.has_device(); }));
}

TEST_F(UsbCameraBankTest, TransfersAreGivenBackWhenTheyAreCancelled) {
  open(1);
  const auto guest = plug(0);
  ASSERT_TRUE(guest->begin_stream(4));
  ASSERT_TRUE(guest->pump_until([&] { return bank_->streaming(0); }));
  guest->cancel_all();
  ASSERT_TRUE(guest->pump_until([&] { return guest->waiting() == 0; }));
  EXPECT_EQ(guest->cancelled(), 4);
  ASSERT_TRUE(guest->pump_until([&] { return !bank_->streaming(0); }));
  bank_->start();
  ASSERT_TRUE(guest->begin_stream(4));
  ASSERT_TRUE(guest->pump_until([&] { return guest->frames().size() >= 2; }));
  EXPECT_TRUE(is_whole(guest->frames().back(), pixels_));
}

TEST_F(UsbCameraBankTest, ClearingTheHaltAndAResetEndTheStream) {
  open(1);
  bank_->start();
  const auto guest = plug(0);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  ASSERT_TRUE(guest->control(0x02, 1, 0, 0x81, 0));
  ASSERT_TRUE(guest->pump_until([&] { return !bank_->streaming(0); }));
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  guest->reset();
  ASSERT_TRUE(guest->pump_until([&] { return !bank_->streaming(0); }));
}

// A board that starts anew: the bus is reset, and what was handed in is given back.
TEST_F(UsbCameraBankTest, AGuestThatResetsTheDeviceStreamsAgain) {
  open(1);
  bank_->start();
  const auto guest = plug(0);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  guest->hand_in_again(false);
  guest->reset();
  ASSERT_TRUE(guest->pump_until([&] { return guest->waiting() == 0; }));
  EXPECT_GT(guest->cancelled(), 0);
  ASSERT_TRUE(guest->set_configuration(1));
  guest->hand_in_again(true);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return guest->frames().size() >= 3; }));
  for (const Bytes& frame : guest->frames()) EXPECT_TRUE(is_whole(frame, pixels_));
}

TEST_F(UsbCameraBankTest, AnEmulatorMayGoAndAnotherCome) {
  open(1);
  bank_->start();
  auto guest = plug(0);
  ASSERT_TRUE(guest->set_exposure(25, 250));
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  guest.reset();
  guest = plug(0);
  EXPECT_DOUBLE_EQ(bank_->exposure(0).gain, 1.0);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return guest->frames().size() >= 2; }));
  EXPECT_TRUE(is_whole(guest->frames().back(), pixels_));
}

// It asks for a frame's beginning and for nothing more.
TEST_F(UsbCameraBankTest, ACameraThatStallsIsLeftOutAndCounted) {
  open(2);
  bank_->start();
  const auto stalled = plug(0);
  const auto other = plug(1);
  stalled->hand_in_again(false);
  ASSERT_TRUE(stalled->begin_stream(2));
  ASSERT_TRUE(stalled->pump_until([&] { return stalled->waiting() == 0; }));
  ASSERT_TRUE(other->begin_stream());
  ASSERT_TRUE(other->pump_until([&] { return bank_->frames_skipped(0) >= 3; }));
  ASSERT_TRUE(other->pump_until([&] { return other->frames().size() >= 3; }));
  EXPECT_TRUE(bank_->streaming(0));
  EXPECT_EQ(bank_->frames_sent(0), 0U);
  stalled->hand_in_again(true);
  stalled->hand_in(512);
  ASSERT_TRUE(stalled->pump_until([&] { return stalled->frames().size() >= 2; }));
  for (const Bytes& frame : stalled->frames()) EXPECT_TRUE(is_whole(frame, pixels_));
}

// Its transfers wait, but the bytes stay in the socket.
TEST_F(UsbCameraBankTest, AnEmulatorThatDoesNotReadHoldsUpNobody) {
  open(2, 640, 480);
  bank_->start();
  const auto deaf = plug(0);
  const auto other = plug(1);
  ASSERT_TRUE(deaf->begin_stream(64, 16384));
  ASSERT_TRUE(deaf->pump());
  ASSERT_TRUE(other->begin_stream(4, 16384));
  ASSERT_TRUE(other->pump_until([&] { return bank_->frames_skipped(0) >= 3; }));
  ASSERT_TRUE(other->pump_until([&] { return other->frames().size() >= 3; }));
  ASSERT_TRUE(deaf->pump_until([&] { return deaf->frames().size() >= 2; }));
  for (const Bytes& frame : deaf->frames()) EXPECT_TRUE(is_whole(frame, pixels_));
}

TEST_F(UsbCameraBankTest, RenderingThatIsLateIsCountedAndNothingHalfDoneIsShown) {
  open(1);
  held_ = true;
  bank_->start();
  const auto guest = plug(0);
  ASSERT_TRUE(guest->begin_stream());
  ASSERT_TRUE(guest->pump_until([&] { return bank_->late_barriers() >= 3; }));
  EXPECT_TRUE(bank_->barriers().empty());
  EXPECT_TRUE(guest->frames().empty());
  held_ = false;
  ASSERT_TRUE(guest->pump_until([&] { return !guest->frames().empty(); }));
  EXPECT_EQ(label_of(guest->frames().front()).barrier, 0);
  EXPECT_TRUE(is_whole(guest->frames().front(), pixels_));
}

TEST(UsbCameraBankOpenTest, SaysInOneLineWhatCannotBe) {
  const test::TemporaryFolder folder;
  const auto complaint = [&](const std::function<void(UsbCameraSetup&)>& spoil) {
    UsbCameraSetup setup;
    setup.folder = folder.path() / "sockets";
    setup.names = {"cam1"};
    spoil(setup);
    const auto bank = UsbCameraBank::open(setup, [](auto, auto&) {});
    return bank ? std::string("opened") : bank.error().message;
  };
  EXPECT_EQ(complaint([](UsbCameraSetup&) {}), "opened");
  EXPECT_THAT(complaint([](UsbCameraSetup& s) { s.names.clear(); }), HasSubstr("one a camera"));
  EXPECT_THAT(complaint([](UsbCameraSetup& s) { s.names = {"caf\xc3\xa9"}; }), HasSubstr("ASCII"));
  EXPECT_THAT(complaint([](UsbCameraSetup& s) { s.width_px = 0; }), HasSubstr("0x480"));
  EXPECT_THAT(complaint([](UsbCameraSetup& s) { s.frame_rate_hz = 0.0; }), HasSubstr("0"));
  const std::string far(120, 'x');
  EXPECT_THAT(complaint([&](UsbCameraSetup& s) { s.folder /= far; }), HasSubstr("characters"));
  const auto file = folder.write("file", "");
  EXPECT_THAT(complaint([&](UsbCameraSetup& s) { s.folder = file / "in"; }), HasSubstr("folder"));
}

}  // namespace
}  // namespace dottrack::host_sim
