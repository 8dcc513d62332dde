#include "host_sim/usb_cameras/scene_cameras.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::host_sim {

Result<UsbCameraSetup> setup_of(const Scene& scene, const std::filesystem::path& folder) {
  if (scene.cameras.empty()) return fail(fmt::format("{}: no cameras", scene.name));
  const SceneCamera& first = scene.cameras.front();
  UsbCameraSetup setup;
  setup.folder = folder;
  setup.width_px = first.camera.width_px();
  setup.height_px = first.camera.height_px();
  setup.frame_rate_hz = scene.frame_rate_hz;
  setup.exposure = {Duration(std::llround(first.exposure_s * 1e9)), first.gain};
  setup.seed = scene.seed;
  for (const SceneCamera& camera : scene.cameras) {
    const bool alike =
        camera.camera.width_px() == setup.width_px && camera.camera.height_px() == setup.height_px;
    if (!alike) {
      return fail(fmt::format("{}: {} has {}x{} pixels, expected {}x{} as {} has", scene.name,
                              camera.name, camera.camera.width_px(), camera.camera.height_px(),
                              setup.width_px, setup.height_px, first.name));
    }
    setup.names.push_back(camera.name);
  }
  return setup;
}

PictureSource pictures_of(const Scene& scene, unsigned threads) {
  auto renderer = std::make_shared<SceneRenderer>(scene, threads);
  return [renderer](std::span<const Exposure> exposures, std::vector<GreyImage>& images) {
    renderer->render(exposures, images);
  };
}

}  // namespace dottrack::host_sim
