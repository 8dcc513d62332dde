// A search that is cut into slices of work comes to the same as one that is not.

#include <gtest/gtest.h>

#include <memory>

#include "app/core/acquisition/acquisition.h"
#include "app/core/acquisition/sightings.h"
#include "app/core/image/band.h"
#include "tests/unit/tracking/painted_room.h"

namespace dottrack::acquisition {
namespace {

using core::test::PaintedRoom;

class SearchSlices : public testing::Test {
 protected:
  SearchSlices() {
    room_.paint_vehicle(PaintedRoom::pose_at(4.3, 2.7, 0.8));
    room_.paint_clutter(60, 4);
    for (std::size_t i = 0; i < room_.rig.cameras.size(); ++i) {
      const core::Camera& camera = room_.rig.cameras[i];
      optics_[i] = geometry::Optics(camera.model, camera.width_px, camera.height_px);
      image::Identifier identifier;
      identifier.identify(room_.frames()[i].image, image::band_of(camera),
                          acquisition_gate(camera, optics_[i], room_.rig.target), regions_[i]);
      regions_of_[i] = &regions_[i];
    }
  }

  // The result, and in how many slices.
  AcquisitionResult search(std::uint64_t units, int& slices) {
    const auto acquisition = std::make_unique<Acquisition>(room_.rig, optics_);
    WorkBudget budget(units);
    acquisition->start(regions_of_, budget);
    for (slices = 1; !acquisition->go_on(budget); ++slices) {
      if (slices > 10'000'000) {
        ADD_FAILURE() << "no end";
        break;
      }
      budget = WorkBudget(units);
    }
    EXPECT_FALSE(acquisition->busy());
    return acquisition->result();
  }

  PaintedRoom room_{5};
  std::array<geometry::Optics, kMaxCameras> optics_;
  std::array<image::Regions, kMaxCameras> regions_;
  std::array<const image::Regions*, kMaxCameras> regions_of_{};
};

TEST_F(SearchSlices, ComeToTheSame) {
  int slices = 0;
  const AcquisitionResult whole = search(1ULL << 60U, slices);
  ASSERT_EQ(whole.reason, core::Reason::none);
  EXPECT_EQ(slices, 1);
  for (const std::uint64_t units : {1ULL, 50ULL, 3000ULL}) {
    const AcquisitionResult cut = search(units, slices);
    EXPECT_GT(slices, 1) << units;
    EXPECT_EQ(cut.reason, whole.reason);
    EXPECT_EQ(cut.candidate.pose.position_m, whole.candidate.pose.position_m);
    EXPECT_EQ(cut.candidate.pose.covariance, whole.candidate.pose.covariance);
    EXPECT_EQ(cut.candidate.log_odds, whole.candidate.log_odds);
    EXPECT_EQ(cut.counts.pairs_accepted, whole.counts.pairs_accepted);
    EXPECT_EQ(cut.counts.finalists, whole.counts.finalists);
    EXPECT_EQ(cut.counts.ticks, static_cast<std::uint32_t>(slices));
  }
}

TEST_F(SearchSlices, BeginWithWhatTheRegionsCost) {
  std::uint64_t regions = 0;
  for (const image::Regions* of_camera : regions_of_) regions += of_camera ? of_camera->size() : 0;
  const auto acquisition = std::make_unique<Acquisition>(room_.rig, optics_);
  WorkBudget budget(1ULL << 60U);
  acquisition->start(regions_of_, budget);
  EXPECT_GT(regions, 100U);
  EXPECT_GE(budget.spent(), regions);
  WorkBudget untouched(1);
  regions_of_.fill(nullptr);
  acquisition->start(regions_of_, untouched);
  EXPECT_EQ(untouched.spent(), 0U);
}

}  // namespace
}  // namespace dottrack::acquisition
