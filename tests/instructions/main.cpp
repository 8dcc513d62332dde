// What identify, an acquisition and a tick of tracking take in instructions, counted by callgrind
// between the two marks. Any machine counts the same: the SIMD instructions are those of SSE 4.

#include <hwy/targets.h>
#include <valgrind/callgrind.h>

#include <cstdio>
#include <memory>
#include <string_view>

#include "app/core/image/identify.h"
#include "app/core/tracker.h"
#include "tests/bench/blob_scene.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

// True when the work came to what it should.
bool identify(const PictureSet& set) {
  const auto identifier = std::make_unique<image::Identifier>();
  const auto regions = std::make_unique<image::Regions>();
  constexpr image::RegionGate kGate{
      .semi_major_min_px = 1.5, .semi_major_max_px = 8.0, .min_axis_ratio = 0.3, .min_fill = 0.7};
  std::uint32_t accepted = 0;
  CALLGRIND_TOGGLE_COLLECT;
  for (const Picture& picture : set) {
    accepted +=
        identifier->identify(picture.view(), {.intensity_min_dn = kBandMin}, kGate, *regions)
            .accepted;
  }
  CALLGRIND_TOGGLE_COLLECT;
  return accepted > 12 * 90;
}

bool is_right(const core::TickResult& result) {
  return result.has_pose && (result.pose.position_m - RoomScene::place_m()).norm() < 0.01;
}

bool acquire(std::size_t dots) {
  const auto scene = std::make_unique<RoomScene>(dots);
  core::Tracker tracker(scene->rig());
  const auto frames = scene->frames();
  CALLGRIND_TOGGLE_COLLECT;
  const core::TickResult& result = tracker.step(frames);
  CALLGRIND_TOGGLE_COLLECT;
  return is_right(result);
}

bool track() {
  const auto scene = std::make_unique<RoomScene>(4);
  core::Rig rig = scene->rig();
  rig.limits.watch_every_ticks = 0;
  core::Tracker tracker(rig);
  const auto frames = scene->frames();
  tracker.step(frames);
  CALLGRIND_TOGGLE_COLLECT;
  const core::TickResult& result = tracker.step(frames);
  CALLGRIND_TOGGLE_COLLECT;
  return is_right(result);
}

bool run(std::string_view what) {
  if (what == "identify/sparse") return identify(sparse_set());
  if (what == "identify/heavy") return identify(heavy_set());
  if (what == "acquire/heavy/4") return acquire(4);
  if (what == "acquire/heavy/8") return acquire(8);
  if (what == "track/12cameras") return track();
  std::fprintf(stderr, "instructions: %.*s; expected a name of figures.txt\n",
               static_cast<int>(what.size()), what.data());
  return false;
}

}  // namespace
}  // namespace dottrack::bench

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  hwy::SetSupportedTargetsForTest(HWY_SSE4 | HWY_SSSE3);
  return dottrack::bench::run(argv[1]) ? 0 : 1;
}
