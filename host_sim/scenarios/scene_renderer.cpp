#include "host_sim/scenarios/scene_renderer.h"

#include <cassert>

#include "host_sim/scenarios/parallel.h"

namespace dottrack::host_sim {

SceneRenderer::SceneRenderer(const Scene& scene, unsigned threads)
    : scene_(scene),
      threads_(threads),
      hall_(scene.world.hall, scene.world.lamps),
      bodies_(scene.world.bodies),
      views_(scene.cameras.size()) {
  for_each_index(views_.size(), threads_, [&](std::size_t i) {
    const SceneCamera& camera = scene_.cameras[i];
    views_[i] = std::make_unique<CameraView>(hall_, camera.camera, camera.sensor);
  });
}

void SceneRenderer::render(std::span<const Exposure> exposures, std::vector<GreyImage>& images) {
  render(exposures, bodies_.moving(), scene_.world.light, images);
}

void SceneRenderer::render(std::span<const Exposure> exposures, std::span<const MovingBody> bodies,
                           const LightPlan& light, std::vector<GreyImage>& images) {
  assert(exposures.size() == views_.size());
  images.resize(views_.size());
  for_each_index(views_.size(), threads_,
                 [&](std::size_t i) { views_[i]->render(exposures[i], bodies, light, images[i]); });
}

void SceneRenderer::collect(std::span<Shot> shots, Detail detail) {
  for (Shot& shot : shots) {
    assert(shot.exposures.size() == views_.size());
    shot.charges_dn.resize(views_.size());
  }
  for_each_index(views_.size(), threads_, [&](std::size_t i) {
    for (Shot& shot : shots) {
      views_[i]->collect(shot.exposures[i], shot.bodies, shot.light, detail, shot.charges_dn[i]);
    }
  });
}

void SceneRenderer::read(const Shot& shot, std::size_t camera, const NoiseKey& noise,
                         GreyImage& image) const {
  Exposure exposure = shot.exposures[camera];
  exposure.noise = noise;
  views_[camera]->read(shot.charges_dn[camera], exposure, image);
}

}  // namespace dottrack::host_sim
