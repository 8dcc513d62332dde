#include "host_sim/scenarios/scene.h"

#include "host_sim/scenarios/parallel.h"

namespace dottrack::host_sim {

double time_s(const Scene& scene, std::uint64_t tick) {
  return static_cast<double>(tick) / scene.frame_rate_hz;
}

Pose truth(const Scene& scene, std::uint64_t tick) {
  return pose_at(scene.world.drive, time_s(scene, tick));
}

SceneRenderer::SceneRenderer(const Scene& scene, unsigned threads)
    : scene_(scene), threads_(threads), renderers_(scene.cameras.size()) {
  for_each_index(renderers_.size(), threads_, [&](std::size_t i) {
    const SceneCamera& camera = scene_.cameras[i];
    renderers_[i] = std::make_unique<CameraRenderer>(scene_.world, camera.camera, camera.sensor);
  });
}

void SceneRenderer::render(std::uint64_t tick, std::vector<GreyImage>& images) {
  images.resize(renderers_.size());
  for_each_index(renderers_.size(), threads_,
                 [&](std::size_t i) { render_camera(i, tick, images[i]); });
}

void SceneRenderer::render_camera(std::size_t camera, std::uint64_t tick, GreyImage& image) {
  renderers_[camera]->render(truth(scene_, tick), {scene_.seed, camera, tick}, image);
}

}  // namespace dottrack::host_sim
