#include "host_sim/scenarios/scene_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "app/config/rig_file.h"
#include "host_sim/scenarios/scenes.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::host_sim {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Scene small_scene() {
  return make_random_scene({.seed = 21, .dots = 7, .cameras = 3, .width_px = 64, .height_px = 48});
}

TEST(SceneFilesTest, TheRigIsOneTheTrackerLoads) {
  const test::TemporaryFolder folder;
  const Scene scene = make_demo_scene(1);
  ASSERT_TRUE(write_rig(scene, folder.path() / "rig"));
  const auto rig = config::load_rig(folder.path() / "rig/rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->frame_rate_hz, scene.frame_rate_hz);
  ASSERT_EQ(rig->cameras.size(), scene.cameras.size());
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    EXPECT_EQ(rig->cameras[i].name, scene.cameras[i].name);
    EXPECT_EQ(rig->rig.cameras[i].width_px, 640);
    EXPECT_EQ(rig->rig.cameras[i].min_contrast_dn, scene.appearance.min_contrast_dn);
  }
  ASSERT_EQ(rig->rig.target.dots.size(), scene.target.size());
  for (std::size_t i = 0; i < scene.target.size(); ++i) {
    EXPECT_EQ(rig->rig.target.dots[i].position_m, scene.target[i].centre_m);
    EXPECT_EQ(rig->rig.target.dots[i].diameter_m, scene.target[i].diameter_m);
  }
}

TEST(SceneFilesTest, FramesAreTheRenderedBytesAfterAPgmHeader) {
  const test::TemporaryFolder folder;
  const Scene scene = small_scene();
  ASSERT_TRUE(write_frames(scene, 4, folder.path()));
  folder.write("cam1/notes.pgm", "not an image of a tick");
  ASSERT_TRUE(write_frames(scene, 3, folder.path()));
  std::vector<GreyImage> images;
  SceneRenderer(scene).render(2, images);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string file = contents(folder.path() / scene.cameras[i].name / "000002.pgm");
    const std::string head = "P5\n64 48\n255\n";
    ASSERT_EQ(file.size(), head.size() + 64U * 48U);
    EXPECT_EQ(file.substr(0, head.size()), head);
    const auto& pixels = images[i].pixels();
    EXPECT_TRUE(
        std::equal(pixels.begin(), pixels.end(), file.begin() + 13,
                   [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "cam1/000003.pgm"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "cam1/notes.pgm"));
}

TEST(SceneFilesTest, TheTruthIsThePoseOfEveryTick) {
  const test::TemporaryFolder folder;
  const Scene scene = small_scene();
  ASSERT_TRUE(write_truth(scene, 50, folder.path() / "truth.tum"));
  std::ifstream in(folder.path() / "truth.tum");
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
  std::uint64_t tick = 0;
  double t = 0.0;
  Eigen::Vector3d p;
  Eigen::Quaterniond q;
  while (in >> t >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w()) {
    const Pose pose = truth(scene, tick);
    EXPECT_NEAR(t, static_cast<double>(tick) / 30.0, 1e-9);
    EXPECT_LT((p - pose.position_m).norm(), 1e-11);
    EXPECT_LT((q.toRotationMatrix() - pose.rotation).norm(), 1e-12);
    if (tick == 0) last = q;
    EXPECT_GT(q.dot(last), 0.9) << "the sign jumps at tick " << tick;
    last = q;
    ++tick;
  }
  EXPECT_EQ(tick, 50U);
}

TEST(SceneFilesTest, SaysWhichFileItCannotWrite) {
  const test::TemporaryFolder folder;
  folder.write("taken", "a file where a folder should be");
  const auto result = write_frames(small_scene(), 1, folder.path() / "taken");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("taken"), std::string::npos);
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace dottrack::host_sim
