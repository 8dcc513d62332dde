#include "drivers/libcamera/luma.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

// jpeglib.h needs cstdio before it
#include <jpeglib.h>

#include "tests/unit/drivers/libcamera/frame_memory_bench.h"

namespace dottrack::drivers {
namespace {

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 48;
constexpr std::size_t kPixels = std::size_t{kWidth_px} * kHeight_px;

using Bytes = std::vector<std::uint8_t>;

// A smooth ramp, which survives the compression nearly as it is.
std::uint8_t ramp(std::size_t i) {
  return static_cast<std::uint8_t>(40 + 2 * (i % kWidth_px) + (i / kWidth_px));
}

// A JPEG of the ramp: grey, or in colour with the ramp as its luma.
Bytes ramp_jpeg(bool colour) {
  jpeg_error_mgr errors{};
  jpeg_compress_struct picture{};
  picture.err = jpeg_std_error(&errors);
  jpeg_create_compress(&picture);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&picture, &data, &size);
  picture.image_width = kWidth_px;
  picture.image_height = kHeight_px;
  picture.input_components = colour ? 3 : 1;
  picture.in_color_space = colour ? JCS_YCbCr : JCS_GRAYSCALE;
  jpeg_set_defaults(&picture);
  jpeg_set_quality(&picture, 95, TRUE);
  jpeg_start_compress(&picture, TRUE);
  const auto channels = static_cast<std::size_t>(picture.input_components);
  Bytes row(kWidth_px * channels, 200);
  for (std::size_t y = 0; y < kHeight_px; ++y) {
    for (std::size_t x = 0; x < kWidth_px; ++x) row[x * channels] = ramp(y * kWidth_px + x);
    JSAMPROW rows[] = {row.data()};
    jpeg_write_scanlines(&picture, rows, 1);
  }
  jpeg_finish_compress(&picture);
  jpeg_destroy_compress(&picture);
  Bytes jpeg(data, data + size);
  std::free(data);
  return jpeg;
}

void expect_ramp(const Bytes& grey) {
  for (std::size_t i = 0; i < kPixels; ++i) ASSERT_NEAR(grey[i], ramp(i), 3) << i;
}

TEST(YuyvLuma, IsEveryOtherByteOfEachRow) {
  constexpr std::ptrdiff_t kStride = 12;  // four bytes more than a row
  const Bytes yuyv{1, 99, 2, 99, 3, 99, 4, 99, 7, 7, 7, 7, 5, 99, 6, 99, 7, 99, 8, 99};
  Bytes grey(8);
  copy_yuyv_luma(yuyv, kStride, 4, 2, grey);
  EXPECT_EQ(grey, (Bytes{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(JpegLuma, IsDecodedFromGreyAndFromColour) {
  JpegLuma decoder;
  Bytes grey(kPixels);
  ASSERT_TRUE(decoder.decode(ramp_jpeg(false), kWidth_px, kHeight_px, grey));
  expect_ramp(grey);
  grey.assign(kPixels, 0);
  ASSERT_TRUE(decoder.decode(ramp_jpeg(true), kWidth_px, kHeight_px, grey));
  expect_ramp(grey);
}

TEST(JpegLuma, OfTruncatedDataIsRefusedAndTheNextPictureIsFine) {
  JpegLuma decoder;
  const Bytes whole = ramp_jpeg(false);
  Bytes grey(kPixels);
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{2}, whole.size() / 4,
                                   whole.size() / 2, whole.size() - 40}) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_FALSE(decoder.decode(part, kWidth_px, kHeight_px, grey)) << length;
    EXPECT_TRUE(decoder.decode(whole, kWidth_px, kHeight_px, grey));
  }
}

TEST(JpegLuma, OfAnotherSizeOrOfNoJpegIsRefused) {
  JpegLuma decoder;
  Bytes grey(4 * kPixels);
  EXPECT_FALSE(decoder.decode(ramp_jpeg(false), kWidth_px, kHeight_px + 1, grey));
  EXPECT_FALSE(decoder.decode(ramp_jpeg(false), kHeight_px, kWidth_px, grey));
  EXPECT_FALSE(decoder.decode(Bytes(1000, 0x55), kWidth_px, kHeight_px, grey));
}

TEST(JpegLuma, ToleratesTheFillBytesThatCamerasPutBehindAPicture) {
  JpegLuma decoder;
  Bytes padded = ramp_jpeg(false);
  padded.resize(padded.size() + 500, 0);
  Bytes grey(kPixels);
  EXPECT_TRUE(decoder.decode(padded, kWidth_px, kHeight_px, grey));
  expect_ramp(grey);
}

TEST(FrameMemory, ShowsGreyWhereTheCameraWroteIt) {
  const test::SharedBuffers shared(2, 64);
  const auto memory =
      shared.map({.packing = Packing::grey, .width_px = 4, .height_px = 3, .stride_bytes = 8});
  Bytes written(64);
  for (std::size_t i = 0; i < written.size(); ++i) written[i] = static_cast<std::uint8_t>(i);
  shared.write(1, written);
  ASSERT_TRUE(memory->accept(1, 2 * 8 + 4));
  const ImageView image = memory->image(1);
  EXPECT_EQ(image.width_px, 4);
  EXPECT_EQ(image.height_px, 3);
  EXPECT_EQ(image.at(0, 0), 0);
  EXPECT_EQ(image.at(3, 2), 19);
}

TEST(FrameMemory, RefusesAFrameThatIsTooShortOrLongerThanItsBuffer) {
  const test::SharedBuffers shared(1, 64);
  const auto memory =
      shared.map({.packing = Packing::grey, .width_px = 4, .height_px = 3, .stride_bytes = 8});
  EXPECT_FALSE(memory->accept(0, 2 * 8 + 3));
  EXPECT_FALSE(memory->accept(0, 0));
  EXPECT_FALSE(memory->accept(0, 65));
}

TEST(FrameMemory, TakesTheLumaOutOfYuyvAndJpeg) {
  const Bytes jpeg = ramp_jpeg(true);
  const test::SharedBuffers shared(1, 2 * kPixels);
  Bytes yuyv(2 * kPixels, 128);
  for (std::size_t i = 0; i < kPixels; ++i) yuyv[2 * i] = ramp(i);
  shared.write(0, yuyv);
  Picture picture{.packing = Packing::yuyv,
                  .width_px = kWidth_px,
                  .height_px = kHeight_px,
                  .stride_bytes = std::ptrdiff_t{2} * kWidth_px};
  const auto packed = shared.map(picture);
  EXPECT_FALSE(packed->accept(0, yuyv.size() - 1));
  ASSERT_TRUE(packed->accept(0, yuyv.size()));
  EXPECT_EQ(packed->image(0).at(10, 5), ramp(std::size_t{5} * kWidth_px + 10));

  shared.write(0, jpeg);
  picture = {
      .packing = Packing::mjpeg, .width_px = kWidth_px, .height_px = kHeight_px, .stride_bytes = 0};
  const auto compressed = shared.map(picture);
  EXPECT_FALSE(compressed->accept(0, jpeg.size() / 2));
  ASSERT_TRUE(compressed->accept(0, jpeg.size()));
  EXPECT_NEAR(compressed->image(0).at(10, 5), ramp(std::size_t{5} * kWidth_px + 10), 3);
}

}  // namespace
}  // namespace dottrack::drivers
