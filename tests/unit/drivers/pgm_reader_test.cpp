#include "drivers/recorded/pgm_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/support/temporary_folder.h"

namespace dottrack::drivers {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int kWidth_px = 4;
constexpr int kHeight_px = 3;
using Pixels = std::array<std::uint8_t, 12>;

class PgmReader : public testing::Test {
 protected:
  Result<void> read(const std::string& bytes) {
    const auto path = folder_.write("frame.pgm", bytes);
    return read_pgm(path, kWidth_px, kHeight_px, pixels_);
  }

  // The one line that a bad file leads to; it names the file and what was expected.
  std::string fault(const std::string& bytes) {
    const Result<void> result = read(bytes);
    if (result) return "no fault";
    const std::string& line = result.error().message;
    EXPECT_THAT(line, HasSubstr((folder_.path() / "frame.pgm").string()));
    EXPECT_THAT(line, HasSubstr("expected a binary PGM (P5) of 4 x 3 pixels with maxval 255"));
    EXPECT_THAT(line, Not(HasSubstr("\n")));
    return line;
  }

  test::TemporaryFolder folder_;
  Pixels pixels_{};
};

const std::string kPixels = "abcdefghijkl";

TEST_F(PgmReader, ReadsPixelsRowByRow) {
  ASSERT_TRUE(read("P5\n4 3\n255\n" + kPixels));
  EXPECT_EQ(std::string(pixels_.begin(), pixels_.end()), kPixels);
}

TEST_F(PgmReader, ReadsAHeaderWithCommentsAndOddSpaces) {
  EXPECT_TRUE(read("P5 # kind\n# a camera\n 4\t3 # size\r\n255\n" + kPixels));
}

TEST_F(PgmReader, TakesPixelsThatLookLikeAHeaderForPixels) {
  ASSERT_TRUE(read("P5\n4 3\n255\n\n# a 25\n12 3"));
  EXPECT_EQ(pixels_[0], '\n');
}

TEST_F(PgmReader, RefusesTruncatedPixels) {
  EXPECT_THAT(fault("P5\n4 3\n255\nabcde"), HasSubstr("is truncated: 5 of 12 bytes of pixels"));
}

TEST_F(PgmReader, RefusesBytesAfterTheLastPixel) {
  EXPECT_THAT(fault("P5\n4 3\n255\n" + kPixels + "m"), HasSubstr("has bytes after its last pixel"));
}

TEST_F(PgmReader, RefusesAnotherSize) {
  EXPECT_THAT(fault("P5\n3 4\n255\n" + kPixels), HasSubstr("is of 3 x 4 pixels"));
  EXPECT_THAT(fault("P5\n0 0\n255\n"), HasSubstr("is of 0 x 0 pixels"));
}

TEST_F(PgmReader, RefusesAbsurdDimensionsWithoutTryingThem) {
  EXPECT_THAT(fault("P5\n999999999 999999999\n255\n"), HasSubstr("is of 999999999 x 999999999"));
  EXPECT_THAT(fault("P5\n99999999999999999999 3\n255\n"),
              HasSubstr("not width, height and maxval"));
  EXPECT_THAT(fault("P5\n-4 3\n255\n" + kPixels), HasSubstr("not width, height and maxval"));
}

TEST_F(PgmReader, RefusesSixteenBitsAPixel) {
  EXPECT_THAT(fault("P5\n4 3\n65535\n" + kPixels + kPixels),
              HasSubstr("has 16 bits a pixel (maxval 65535)"));
}

TEST_F(PgmReader, RefusesAnotherScaleOfGreys) {
  EXPECT_THAT(fault("P5\n4 3\n100\n" + kPixels), HasSubstr("has maxval 100"));
}

TEST_F(PgmReader, RefusesOtherKindsOfFiles) {
  for (const char* start : {"", "P", "P2\n4 3\n255\n", "P6\n4 3\n255\n", "P55\n4 3\n255\n",
                            "\x89PNG\r\n\x1a\n", "a picture"}) {
    EXPECT_THAT(fault(start + kPixels), HasSubstr("does not start with P5")) << start;
  }
  EXPECT_THAT(fault(""), HasSubstr("does not start with P5"));
}

TEST_F(PgmReader, RefusesAHeaderThatIsCutShortOrGarbage) {
  for (const char* header :
       {"P5\n", "P5\n4", "P5\n4 3\n", "P5\n4 3\n255", "P5\n4 3\n25", "P5 # a"}) {
    EXPECT_THAT(fault(header), HasSubstr("ends inside its header")) << header;
  }
  EXPECT_THAT(fault("P5\nwide high\n255\n" + kPixels), HasSubstr("not width, height and maxval"));
  EXPECT_THAT(fault("P5\n4 3\n255x" + kPixels), HasSubstr("does not end in one white space"));
}

TEST_F(PgmReader, SaysWhenThereIsNoFile) {
  const auto result = read_pgm(folder_.path() / "absent.pgm", kWidth_px, kHeight_px, pixels_);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("absent.pgm is not a file"));
}

TEST_F(PgmReader, SaysWhenAFolderBearsTheName) {
  EXPECT_FALSE(read_pgm(folder_.path(), kWidth_px, kHeight_px, pixels_));
}

}  // namespace
}  // namespace dottrack::drivers
