#include "host_sim/scenarios/scene_renderer.h"

#include <cassert>
#include <limits>

#include "host_sim/scenarios/parallel.h"

namespace dottrack::host_sim {

SceneRenderer::SceneRenderer(const Scene& scene, unsigned threads)
    : scene_(scene),
      threads_(threads),
      hall_(scene.world.hall, scene.world.lamps),
      bodies_(scene.world.bodies),
      stands_(scene.cameras.size()) {
  for_each_index(stands_.size(), threads_, [&](std::size_t i) { stands_[i] = stands_of(i); });
}

SceneRenderer::Stands SceneRenderer::stands_of(std::size_t camera) const {
  const SceneCamera& as_mounted = scene_.cameras[camera];
  SimCamera now = as_mounted.camera;
  Stands stands;
  stands.push_back({std::numeric_limits<double>::lowest(),
                    std::make_unique<CameraView>(hall_, now, as_mounted.sensor)});
  for (const CameraMove& move : scene_.camera_moves) {
    if (move.camera != camera) continue;
    now = moved(now, move);
    stands.push_back({move.at_s, std::make_unique<CameraView>(hall_, now, as_mounted.sensor)});
  }
  return stands;
}

CameraView& SceneRenderer::view(std::size_t camera, double time_s) const {
  const Stands& stands = stands_[camera];
  std::size_t last = stands.size() - 1;
  while (stands[last].from_s > time_s) --last;
  return *stands[last].view;
}

void SceneRenderer::render(std::span<const Exposure> exposures, std::vector<GreyImage>& images) {
  render(exposures, bodies_.moving(), scene_.world.light, images);
}

void SceneRenderer::render(std::span<const Exposure> exposures, std::span<const MovingBody> bodies,
                           const LightPlan& light, std::vector<GreyImage>& images) {
  assert(exposures.size() == stands_.size());
  images.resize(stands_.size());
  for_each_index(stands_.size(), threads_, [&](std::size_t i) {
    view(i, exposures[i].middle_s).render(exposures[i], bodies, light, images[i]);
  });
}

void SceneRenderer::collect(std::span<Shot> shots, Detail detail) {
  for (Shot& shot : shots) {
    assert(shot.exposures.size() == stands_.size());
    shot.charges_dn.resize(stands_.size());
  }
  for_each_index(stands_.size(), threads_, [&](std::size_t i) {
    for (Shot& shot : shots) {
      const Exposure& exposure = shot.exposures[i];
      view(i, exposure.middle_s)
          .collect(exposure, shot.bodies, shot.light, detail, shot.charges_dn[i]);
    }
  });
}

void SceneRenderer::read(const Shot& shot, std::size_t camera, const NoiseKey& noise,
                         GreyImage& image) const {
  Exposure exposure = shot.exposures[camera];
  exposure.noise = noise;
  view(camera, exposure.middle_s).read(shot.charges_dn[camera], exposure, image);
}

}  // namespace dottrack::host_sim
