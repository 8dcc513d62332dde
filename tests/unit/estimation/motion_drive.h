#pragma once
// A filter taken along with a moving vehicle, four cameras a tick that see a part of the pose each.

#include <functional>

#include "app/core/estimation/pose_filter.h"
#include "tests/unit/estimation/moving_vehicle.h"

namespace dottrack::estimation {

struct DriveSettings {
  double rate_hz = 30.0;
  double sigma_m = 0.001;  // of one coordinate, of which each camera sees `coordinates`
  int coordinates = 4;     // fewer than the six of a pose
  int cameras = 4;
  bool synchronised = false;  // else they are spread over the tick
  std::uint64_t seed = 1;
};

Time time_at(double seconds);
core::Pose pose_from(const PoseInformation& all);

template <class Vehicle>
class Drive {
 public:
  Drive(const core::MotionLimits& limits, Vehicle moving, const DriveSettings& settings)
      : filter(limits), vehicle(std::move(moving)), settings_(settings), random_(settings.seed) {
    vehicle.advance_to(now_s);
    raw = look(vehicle.truth(), time_at(now_s), 12, settings_.sigma_m, random_);
    filter.start(pose_from(raw), time_at(now_s));
  }

  UpdateResult tick() {
    ++ticks;
    views.clear();
    for (int i = 0; i < settings_.cameras; ++i) {
      const double part = settings_.synchronised ? 1.0 : (i + 1.0) / settings_.cameras;
      now_s = 1.0 + (ticks - 1 + part) / settings_.rate_hz;
      vehicle.advance_to(now_s);
      views.push_back(
          look(vehicle.truth(), time_at(now_s), settings_.coordinates, settings_.sigma_m, random_));
    }
    raw = views.front();
    for (std::size_t i = 1; i < views.size(); ++i) add(views[i], raw);
    return filter.update(views);
  }

  PoseFilter filter;
  Vehicle vehicle;
  PoseInformation raw;  // of all cameras of the last tick together; meaningful if synchronised
  std::vector<PoseInformation> views;
  double now_s = 1.0;
  int ticks = 0;

 private:
  DriveSettings settings_;
  Random random_;
};

// Normalised squared errors of a pose: their mean, and how many lie in the 95 % ellipsoid.
class Consistency {
 public:
  void add(double normalised_squared_error);
  int samples() const { return samples_; }
  double mean() const { return sum_ / samples_; }
  double part_inside() const { return static_cast<double>(inside_) / samples_; }
  double band() const;  // of the mean, 95 %, to either side of 6

 private:
  int samples_ = 0;
  int inside_ = 0;
  double sum_ = 0.0;
};

}  // namespace dottrack::estimation
