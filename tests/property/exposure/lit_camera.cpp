#include "tests/property/exposure/lit_camera.h"

#include <algorithm>
#include <cmath>

namespace dottrack::exposure_test {
namespace {

constexpr std::size_t kDeviates = 65521;

const std::vector<double>& deviates() {
  static const std::vector<double> kNormal = [] {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<double> drawn(kDeviates);
    for (double& deviate : drawn) deviate = normal(random);
    return drawn;
  }();
  return kNormal;
}

// How bright each pixel is, of the dot's light.
std::vector<double> shares_of(double ground) {
  std::vector<double> shares;
  for (int y = 0; y < LitCamera::kSide_px; ++y) {
    for (int x = 0; x < LitCamera::kSide_px; ++x) {
      const double from_middle = std::hypot(x - LitCamera::kCentre_px, y - LitCamera::kCentre_px);
      const double inside = std::clamp(LitCamera::kRadius_px + 0.5 - from_middle, 0.0, 1.0);
      shares.push_back(ground + (1.0 - ground) * inside);
    }
  }
  return shares;
}

}  // namespace

using exposure::CameraOrders;
using exposure::ExposureSetting;
using exposure::IrisAct;

LitCamera::LitCamera(const Plant& plant, const exposure::LightSettings& settings)
    : plant_(plant),
      rig_(rig()),
      control_(rig_, settings),
      pixels_(static_cast<std::size_t>(kSide_px * kSide_px)),
      shares_(shares_of(plant.ground)),
      random_(plant.seed),
      motor_(plant.opening),
      target_(plant.opening),
      blades_(plant.opening) {
  ordered_.assign(static_cast<std::size_t>(plant.delay_ticks), settings.start[0]);
}

core::Rig LitCamera::rig() {
  core::Rig rig;
  rig.cameras.resize(1);
  rig.target.dots.resize(1);
  return rig;
}

double LitCamera::opening_in_effect() const {
  return std::clamp(blades_ * wear_, 0.02, 1.0);
}

void LitCamera::paint() {
  const ExposureSetting& now =
      ordered_[ordered_.size() - static_cast<std::size_t>(plant_.delay_ticks)];
  level_dn_ = plant_.light_dn_per_s * to_seconds(now.exposure) * now.gain * opening_in_effect();
  std::size_t deviate = random_();
  for (int y = 0; y < kSide_px; ++y) {
    for (int x = 0; x < kSide_px; ++x) {
      const auto at = static_cast<std::size_t>(y * kSide_px + x);
      const double noise = 1.0 + plant_.noise * deviates()[++deviate % kDeviates];
      const double dn = level_dn_ * shares_[at] * noise;
      pixels_[at] = static_cast<std::uint8_t>(std::clamp(dn, 0.0, 255.0));
    }
  }
}

// The tracker sees the dot while it stands out: neither dark nor lost in a ground as white.
core::TickResult LitCamera::result() const {
  core::TickResult result;
  result.cameras[0].delivered = true;
  const double ground_dn = plant_.ground * level_dn_;
  if (hidden_ || level_dn_ < 25.0 || ground_dn > 150.0) return result;
  result.has_pose = true;
  result.dots[0].views[0] = {
      .seen = true,
      .used = true,
      .bloomed = false,
      .pixel = {static_cast<float>(kCentre_px), static_cast<float>(kCentre_px)},
      .semi_major_px = static_cast<float>(kRadius_px),
      .semi_minor_px = static_cast<float>(kRadius_px),
      .angle_rad = 0.0F,
      .residual_px = 0.0F};
  return result;
}

void LitCamera::turn_iris() {
  wear_ *= 1.0 + plant_.wear_per_tick;
  if (automatic_) return;
  motor_ += std::clamp(target_ - motor_, -plant_.speed_per_tick, plant_.speed_per_tick);
  if (plant_.stuck) return;
  blades_ = std::clamp(blades_, motor_ - 0.5 * plant_.backlash, motor_ + 0.5 * plant_.backlash);
}

void LitCamera::obey(const CameraOrders& orders) {
  ordered_.push_back(orders.exposure.value_or(ordered_.back()));
  exposures_ordered_ += orders.exposure ? 1 : 0;
  if (orders.iris.act == IrisAct::none) return;
  automatic_ = orders.iris.act == IrisAct::release;
  if (automatic_) return;
  ++moves_ordered_;
  target_ = std::clamp(orders.iris.opening, 0.05, 1.0);
}

void LitCamera::tick() {
  turn_iris();
  paint();
  core::CameraFrame frame;
  frame.delivered = true;
  frame.image = {pixels_.data(), kSide_px, kSide_px, kSide_px};
  const core::TickResult seen = result();
  control_.read(0, frame, seen);
  control_.end_readings(seen);
  const double says = automatic_ ? blades_ : motor_;
  obey(control_.decide(0, {says, !automatic_ && motor_ != target_, automatic_, true}));
}

}  // namespace dottrack::exposure_test
