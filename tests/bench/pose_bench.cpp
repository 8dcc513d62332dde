// The pose from all views at once: eight dots, each seen by twelve cameras.

#include <benchmark/benchmark.h>

#include <memory>
#include <random>

#include "app/core/estimation/pose_fit.h"
#include "app/core/geometry/camera_model.h"
#include "tests/bench/room_scene.h"

namespace dottrack::bench {
namespace {

constexpr std::size_t kDots = 8;
constexpr double kSigma_px = 0.02;

// Of the target in the middle of the room, with a dot fit's noise.
estimation::DotObservations views_of(const core::Rig& rig) {
  std::mt19937_64 random(29);
  std::normal_distribution<double> noise(0.0, kSigma_px);
  estimation::DotObservations views;
  for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
    for (std::size_t dot = 0; dot < kDots; ++dot) {
      estimation::DotObservation view;
      const Eigen::Vector3d place_m = RoomScene::place_m() + rig.target.dots[dot].position_m;
      if (geometry::project(rig.cameras[camera].model, place_m, view.centre_px) !=
          geometry::OpticsStatus::ok) {
        continue;
      }
      view.camera = static_cast<std::uint8_t>(camera);
      view.dot = static_cast<std::uint8_t>(dot);
      view.centre_px += Eigen::Vector2d(noise(random), noise(random));
      view.covariance_px2 = kSigma_px * kSigma_px * Eigen::Matrix2d::Identity();
      views.push_back(view);
    }
  }
  return views;
}

// From where triangulated dots put it, some millimetres off.
void pose_fit(benchmark::State& state) {
  const core::Rig rig = room_rig(kDots);
  const estimation::DotObservations views = views_of(rig);
  const geometry::RigidMotion start{RoomScene::place_m() + Eigen::Vector3d(0.003, -0.002, 0.004),
                                    Eigen::Quaterniond::Identity()};
  estimation::PoseFitter fitter(rig);
  const auto fit = std::make_unique<estimation::PoseFit>();
  bool right = views.size() == kRoomCameras * kDots;
  for (auto _ : state) {
    const estimation::PoseFitStatus status =
        fitter.fit(as_span(views), {}, start, estimation::DotSpread::none(), *fit);
    right = right && status == estimation::PoseFitStatus::ok;
  }
  const double off_m = (fit->pose.position_m - RoomScene::place_m()).norm();
  if (!right || off_m > 0.001) state.SkipWithError("the pose was not found");
  state.counters["views"] = static_cast<double>(views.size());
}

BENCHMARK(pose_fit)->Name("pose_fit/96views")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dottrack::bench
