// How a picture is cut into transfers.

#include "host_sim/usb_cameras/uvc_frame.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/unit/host_sim/uvc_reassembly.h"

namespace dottrack::host_sim {
namespace {

std::shared_ptr<const GreyImage> picture(int width_px, int height_px, int salt) {
  auto image = std::make_shared<GreyImage>(width_px, height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      image->at(x, y) = static_cast<std::uint8_t>(x * 7 + y * 31 + salt);
    }
  }
  return image;
}

class UvcFrameTest : public testing::TestWithParam<std::tuple<int, std::size_t>> {};

// Sizes and transfers at which payloads end within a transfer, and exactly with one.
TEST_P(UvcFrameTest, ArrivesWhole) {
  const auto [width_px, room] = GetParam();
  UvcFrame frame;
  test::UvcReassembly host(static_cast<std::size_t>(width_px) * 3 + kPayloadHeader_bytes);
  for (int k = 0; k < 3; ++k) {
    const auto image = picture(width_px, 3, k);
    frame.begin(image);
    std::size_t pieces = 0;
    while (frame.in_transit()) {
      const Bytes& piece = frame.next_piece(room);
      ASSERT_LE(piece.size(), room);
      ASSERT_LE(++pieces, image->pixels().size() / (room - 2) + 6);
      host.take(piece, room);
    }
    ASSERT_EQ(host.frames().size(), static_cast<std::size_t>(k) + 1);
    EXPECT_EQ(host.frames().back(), image->pixels());
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, UvcFrameTest,
                         testing::Combine(testing::Values(1, 85, 170, 171, 640),
                                          testing::Values(3, 64, 128, 256, 512, 834, 16384)));

TEST(UvcFrameBeginTest, TheFirstPieceIsShort) {
  UvcFrame frame;
  frame.begin(picture(640, 480, 0));
  EXPECT_EQ(frame.next_piece(16384).size(), UvcFrame::kFirstPayload_bytes);
  EXPECT_EQ(frame.next_piece(16384).size(), 16384U);
}

TEST(UvcFrameBeginTest, AFrameThatIsAbandonedIsNeverTakenForWhole) {
  UvcFrame frame;
  test::UvcReassembly host(640 * 480 + kPayloadHeader_bytes);
  frame.begin(picture(640, 480, 0));
  host.take(frame.next_piece(16384), 16384);
  frame.abandon();
  EXPECT_FALSE(frame.in_transit());
  const auto next = picture(640, 480, 9);
  frame.begin(next);
  while (frame.in_transit()) host.take(frame.next_piece(16384), 16384);
  ASSERT_EQ(host.frames().size(), 1U);
  EXPECT_EQ(host.frames().front(), next->pixels());
}

}  // namespace
}  // namespace dottrack::host_sim
