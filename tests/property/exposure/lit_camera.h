#pragma once
// A camera with a lens in front of light control, as far as light goes: settings that take effect
// later, an iris with play, wear and a speed, noise, a sensor that saturates. Its picture shows one
// dot on a darker ground.

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "app/core/exposure/light_control.h"

namespace dottrack::exposure_test {

struct Plant {
  double light_dn_per_s = 40000.0;  // of the dot, at unit gain and a fully open iris
  double ground = 0.25;             // of the dot's light
  int delay_ticks = 2;
  double opening = 0.5;
  double backlash = 0.02;
  double speed_per_tick = 0.02;
  double wear_per_tick = 0.0;  // relative
  double noise = 0.01;         // relative, one sigma
  bool stuck = false;
  std::uint32_t seed = 1;
};

class LitCamera {
 public:
  static constexpr int kSide_px = 64;
  static constexpr double kRadius_px = 7.0;
  static constexpr double kCentre_px = 31.5;

  LitCamera(const Plant& plant, const exposure::LightSettings& settings);

  // One tick: the picture, then what light control orders.
  void tick();
  void set_light(double light_dn_per_s) { plant_.light_dn_per_s = light_dn_per_s; }
  // The tracker has lost the dot, whatever the picture.
  void hide(bool hidden) { hidden_ = hidden; }
  void stick(bool stuck) { plant_.stuck = stuck; }

  double level_dn() const { return level_dn_; }  // the dot's in this tick's picture, unbounded
  bool saturated() const { return level_dn_ > 255.0; }
  double opening() const { return blades_; }
  bool automatic() const { return automatic_; }
  int exposures_ordered() const { return exposures_ordered_; }
  int moves_ordered() const { return moves_ordered_; }
  const exposure::CameraLight& light() const { return control_.light(0); }

 private:
  static core::Rig rig();
  double opening_in_effect() const;
  void paint();
  core::TickResult result() const;
  void obey(const exposure::CameraOrders& orders);
  void turn_iris();

  Plant plant_;
  core::Rig rig_;
  exposure::LightControl control_;
  std::vector<std::uint8_t> pixels_;
  std::vector<double> shares_;
  std::vector<exposure::ExposureSetting> ordered_;  // one a tick: in force delay_ticks later
  std::mt19937 random_;
  double level_dn_ = 0.0;
  double motor_ = 0.0;
  double target_ = 0.0;
  double blades_ = 0.0;
  double wear_ = 1.0;
  bool automatic_ = true;
  bool hidden_ = false;
  int exposures_ordered_ = 0;
  int moves_ordered_ = 0;
};

}  // namespace dottrack::exposure_test
