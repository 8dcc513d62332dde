// Whatever SIMD instructions the processor has, the regions are the same to the last bit.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstring>
#include <memory>

#include "app/core/image/identify.h"
#include "tests/unit/image/pictures.h"

namespace dottrack::image::test {
namespace {

class IdentifyTargets : public testing::Test {
 protected:
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }

  void identify(std::int64_t target, const Picture& picture, const Band& band, Regions& regions) {
    hwy::SetSupportedTargetsForTest(target);
    identifier_.identify(picture.view(), band, {}, regions);
  }

  Random random_{99};
  Identifier identifier_;
  std::unique_ptr<Regions> best_ = std::make_unique<Regions>();
  std::unique_ptr<Regions> other_ = std::make_unique<Regions>();
};

bool same(const Region& a, const Region& b) {
  return a.centroid_px == b.centroid_px && a.semi_major_px == b.semi_major_px &&
         a.semi_minor_px == b.semi_minor_px && a.angle_rad == b.angle_rad &&
         a.area_px == b.area_px && a.box_misfit_px == b.box_misfit_px &&
         a.core_contrast_dn == b.core_contrast_dn && a.saturated_px == b.saturated_px &&
         a.x_min == b.x_min && a.x_max == b.x_max && a.y_min == b.y_min && a.y_max == b.y_max &&
         a.touches_border == b.touches_border;
}

TEST_F(IdentifyTargets, GiveTheSameRegions) {
  const auto targets = hwy::SupportedAndGeneratedTargets();
#if HWY_ARCH_X86
  ASSERT_GE(targets.size(), 2U);
#endif
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const Picture picture = random_picture(random_, 250);
    Band band{.intensity_min_dn = integer(random_, 0, 150)};
    band.min_contrast_dn = i % 2 == 0 ? 0 : integer(random_, 1, 40);
    band.background_px = 2 * integer(random_, 1, 40) + 1;
    band.polarity = i % 4 < 2 ? core::Polarity::bright : core::Polarity::dark;
    identify(0, picture, band, *best_);
    for (const std::int64_t target : targets) {
      identify(target, picture, band, *other_);
      ASSERT_EQ(best_->size(), other_->size()) << hwy::TargetName(target);
      for (std::size_t k = 0; k < best_->size(); ++k) {
        ASSERT_TRUE(same((*best_)[k], (*other_)[k])) << hwy::TargetName(target);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 10000 * static_cast<int>(targets.size()));
}

}  // namespace
}  // namespace dottrack::image::test
