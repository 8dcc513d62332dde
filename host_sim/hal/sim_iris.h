#pragma once
// The irises of the simulated cameras: they take their time, have play and wander off.

#include <array>
#include <utility>
#include <vector>

#include "hal/base/camera_set.h"
#include "hal/iris.h"
#include "host_sim/hal/hardware_model.h"
#include "host_sim/scenarios/scene.h"
#include "rtos_shim/clock.h"

namespace dottrack::host_sim {

// Where an iris stands is a pure function of the requests so far and the time, however often it is
// asked. An automatic iris holds its opening and drifts; one that was sent somewhere goes there at
// the model's speed and comes to rest up to half the backlash away, on the side it came from. Wear
// and stuck blades show in the light alone: the iris still says where it should be.
class SimIris final : public hal::Iris {
 public:
  // At most kMaxCameras cameras; all start as the model says, in automatic mode. `clock` outlives
  // this.
  SimIris(std::size_t cameras, const IrisModel& model, const rtos::Clock& clock,
          std::vector<IrisFault> faults = {});
  SimIris(const Scene& scene, const rtos::Clock& clock)
      : SimIris(scene.cameras.size(), scene.iris, clock, scene.iris_faults) {}

  // Share of the light of a fully open iris, at an instant not before the last request.
  double opening(std::size_t camera, Time at) const;

 private:
  struct Blades {  // as they were at the last request
    Time since{};
    double opening = 1.0;
    double motor = 1.0;   // what turns the blades, half the backlash ahead of them
    double target = 1.0;  // of the motor
    bool automatic = true;
  };

  bool do_move_to(std::size_t camera, double opening) override;
  bool do_release_to_auto(std::size_t camera) override;
  hal::IrisState do_state(std::size_t camera) const override;

  double motor_at(const Blades& blades, Time at) const;
  double commanded(const Blades& blades, Time at) const;
  double within_range(double opening) const;
  void hold(std::size_t camera, Time now);
  const IrisFault* fault(std::size_t camera, Time at) const;

  std::size_t cameras_;
  IrisModel model_;
  const rtos::Clock& clock_;
  std::vector<IrisFault> faults_;
  std::array<Blades, kMaxCameras> blades_{};
  std::array<double, kMaxCameras> held_{};  // openings at which faults hold blades
};

}  // namespace dottrack::host_sim
