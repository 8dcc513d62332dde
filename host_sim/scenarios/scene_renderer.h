#pragma once
// A scene through all of its cameras.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "host_sim/renderer/camera_view.h"
#include "host_sim/scenarios/body_scenes.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::host_sim {

// The bytes depend on the scene and the exposures alone, never on the number of threads. What a
// thread throws is thrown again by the call. Not for two threads at once,
// where nothing else is said.
class SceneRenderer {
 public:
  // Renders the hall without its bodies: seconds. `scene` must outlive this and stay as it is.
  // threads 0: as many as the machine has.
  explicit SceneRenderer(const Scene& scene, unsigned threads = 0);

  // One exposure and one picture a camera, in the scene's order.
  void render(std::span<const Exposure> exposures, std::vector<GreyImage>& images);

  // The same hall and cameras with other bodies and another plan of the light.
  void render(std::span<const Exposure> exposures, std::span<const MovingBody> bodies,
              const LightPlan& light, std::vector<GreyImage>& images);

  // One picture of all cameras, before it is read out.
  struct Shot {
    std::vector<Exposure> exposures;  // one a camera
    std::span<const MovingBody> bodies;
    LightPlan light;
    std::vector<FloatImage> charges_dn;  // one a camera: what its pixels hold (sensor.h)
  };

  // Fills in what the pixels of every shot hold: camera by camera, which keeps threads busy.
  void collect(std::span<Shot> shots, Detail detail);

  // Reads out one camera of a shot, with the noise of the shot's exposure or of another. Any number
  // of threads may read.
  void read(const Shot& shot, std::size_t camera, const NoiseKey& noise, GreyImage& image) const;

  const Hall& hall() const { return hall_; }
  unsigned threads() const { return threads_; }
  // The scene's own, in its order.
  std::span<const MovingBody> bodies() const { return bodies_.moving(); }

 private:
  const Scene& scene_;
  unsigned threads_;
  Hall hall_;
  BodyScenes bodies_;
  // A camera as it stands from an instant on.
  struct Stand {
    double from_s;
    std::unique_ptr<CameraView> view;
  };
  using Stands = std::vector<Stand>;

  Stands stands_of(std::size_t camera) const;
  CameraView& view(std::size_t camera, double time_s) const;

  std::vector<Stands> stands_;  // one a camera, in order of time
};

}  // namespace dottrack::host_sim
