// Surveys, places, seeds and pictures as people hand them in.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/workstation/calibrate/input/picture_folder.h"
#include "app/workstation/calibrate/input/survey_file.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::calibrate {
namespace {

using testing::HasSubstr;

class Input : public testing::Test {
 protected:
  Result<std::vector<SurveyedDot>> survey(const std::string& text) {
    return read_survey(folder_.write("dots.csv", text));
  }
  std::string complaint(const std::string& text) {
    const auto dots = survey(text);
    return dots ? "none" : dots.error().message.substr(folder_.path().string().size() + 1);
  }
  test::TemporaryFolder folder_;
};

TEST_F(Input, ReadsLengthsInTheUnitOfTheirHeading) {
  const auto dots = survey("id,X_mm,Y_cm,Z_m,sigma_mm,diameter_mm\n7,1000,200,3,2,50\n");
  ASSERT_TRUE(dots) << dots.error().message;
  ASSERT_EQ(dots->size(), 1U);
  EXPECT_EQ(dots->front().name, "7");
  EXPECT_TRUE(dots->front().position_m.isApprox(Eigen::Vector3d(1.0, 2.0, 3.0)));
  EXPECT_TRUE(dots->front().sigma_m.isApproxToConstant(0.002));
  EXPECT_DOUBLE_EQ(dots->front().diameter_m, 0.05);
  EXPECT_FALSE(dots->front().normal);
  EXPECT_FALSE(dots->front().tick);
}

TEST_F(Input, ReadsNormalsAndTicks) {
  const auto dots =
      survey("dot,x_m,y_m,z_m,nx,ny,nz,tick\na,0,0,0,0,0,1,5\na,1,0,0,,,,6\nb,2,0,0,1,0,0,\n");
  ASSERT_TRUE(dots) << dots.error().message;
  ASSERT_EQ(dots->size(), 3U);
  EXPECT_EQ((*dots)[0].normal, Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ((*dots)[0].tick, 5U);
  EXPECT_FALSE((*dots)[1].normal);
  EXPECT_FALSE((*dots)[2].tick);
}

TEST_F(Input, SaysWhatIsWrongWithASurvey) {
  EXPECT_EQ(complaint("dot,x,y,z\na,0,0,0\n"),
            "dots.csv: coordinates without a unit; expected the headings dot,x_m,y_m,z_m (or _cm, "
            "_mm)");
  EXPECT_THAT(complaint("dot,x_m,y_m,z_m\na,0,0,zero\n"),
              HasSubstr("dots.csv:2: z_m is \"zero\"; expected a number"));
  EXPECT_THAT(complaint("dot,x_m,y_m,z_m\na,0,0,0\na,1,0,0\n"),
              HasSubstr("dots.csv:3: dot \"a\" again, first on line 2"));
  EXPECT_THAT(complaint("dot,x_m,y_m,z_m\na,0,0\n"), HasSubstr("dots.csv:2: 3 fields"));
  EXPECT_THAT(complaint("dot,x_m,y_m,z_m,nx,ny,nz\na,0,0,0,0,0,2\n"),
              HasSubstr("a vector of length 2"));
  EXPECT_THAT(complaint(""), HasSubstr("nothing in it"));
}

TEST_F(Input, WantsFourSeedsOfDotsThatThereAre) {
  const auto dots = survey("dot,x_m,y_m,z_m\na,0,0,0\nb,1,0,0\n");
  ASSERT_TRUE(dots);
  const auto few = read_seeds(
      folder_.write("seeds.csv", "camera,dot,x_px,y_px\ncam1,a,1,2\ncam1,b,3,4\n"), *dots);
  ASSERT_FALSE(few);
  EXPECT_THAT(few.error().message, HasSubstr("too few seeds of camera \"cam1\""));
  const auto unknown =
      read_seeds(folder_.write("seeds.csv", "camera,dot,x_px,y_px\ncam1,c,1,2\n"), *dots);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("dot \"c\"; expected a dot of the survey"));
}

TEST_F(Input, ListsCamerasByTheirNumbers) {
  for (const char* file : {"cam10/000000.pgm", "cam2/000003.pgm", "cam2/000001.pgm", "cam1.pgm"}) {
    folder_.write(file, "P5\n1 1\n255\n1");
  }
  folder_.write("approximate/rig.toml", "");
  const auto cameras = list_pictures(folder_.path());
  ASSERT_TRUE(cameras) << cameras.error().message;
  ASSERT_EQ(cameras->size(), 3U);
  EXPECT_EQ((*cameras)[0].name, "cam1");
  EXPECT_EQ((*cameras)[1].name, "cam2");
  EXPECT_EQ((*cameras)[2].name, "cam10");
  EXPECT_EQ((*cameras)[1].files.size(), 2U);
  EXPECT_EQ((*cameras)[1].of_tick.count(3), 1U);
  EXPECT_FALSE(list_pictures(folder_.path() / "approximate"));
}

TEST_F(Input, AveragesPictures) {
  const auto a = folder_.write("a.pgm", std::string("P5\n2 1\n255\n") + "\x0A\x20");
  const auto b = folder_.write("b.pgm", std::string("P5\n2 1\n255\n") + "\x14\x21");
  const auto mean = mean_picture({a, b});
  ASSERT_TRUE(mean) << mean.error().message;
  EXPECT_EQ(mean->pixels, (std::vector<std::uint8_t>{15, 33}));
  EXPECT_FALSE(read_picture(folder_.write("c.pgm", "P2\n1 1\n255\n1")));
}

}  // namespace
}  // namespace dottrack::calibrate
