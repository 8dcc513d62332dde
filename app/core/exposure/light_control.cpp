#include "app/core/exposure/light_control.h"

#include <algorithm>

namespace dottrack::exposure {
namespace {

constexpr int kNearFullScale_dn = 250;
constexpr double kSaturatedDots = 0.1;    // of their pixels
constexpr double kSaturatedImage = 0.25;  // its mean is no measure then
constexpr double kSaturatedParts = 0.02;  // of an image that is known for nothing else
// How far a level that is only inferred may be off.
constexpr double kToleranceOfLost = 1.3;
constexpr double kToleranceOfUnseen = 1.6;
constexpr double kToleranceOfImage = 2.0;
constexpr double kDarkImage_dn = 8.0;  // below, its mean does not tell what an iris does
constexpr int kSpreadAfter_ticks = 15;
constexpr double kSpread = 3.0;
constexpr int kPlaces = 3;
constexpr double kNear = 1.1;  // an end
constexpr int kRefused_ticks = 300;
// The iris opens where more gain than this is needed, and closes where the exposure is this close
// to the shortest one.
constexpr double kMuchGain = 1.5;
constexpr double kShort = 1.5;
// Before it opens, the dots are not far above where they should be: what it lets in comes on top.
constexpr double kHeadroom = 1.08;
constexpr double kToleranceBeforeIris = 1.06;
constexpr double kToleranceOfExercise = 1.4;  // the iris goes back by itself

int rounded(double dn) {
  return static_cast<int>(dn + 0.5);
}

}  // namespace

LightControl::LightControl(const core::Rig& rig, const LightSettings& settings)
    : settings_(settings), meter_(rig) {
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    cameras_[i].exposure = ExposureLoop(settings_, settings_.start[i]);
    cameras_[i].light.setting = settings_.start[i];
  }
}

void LightControl::read(std::size_t camera, const core::CameraFrame& frame,
                        const core::TickResult& result) {
  cameras_[camera].reading = meter_.read(camera, frame, result);
  remember(cameras_[camera]);
}

void LightControl::end_readings(const core::TickResult& result) {
  has_pose_ = result.has_pose;
  searching_ticks_ = has_pose_ ? 0 : searching_ticks_ + 1;
}

void LightControl::remember(Camera& camera) const {
  const LightReading& reading = camera.reading;
  if (reading.dots == 0 || reading.saturated_px > 0 || !(reading.image.mean_dn > 1.0)) return;
  camera.dots_over_image = reading.brightest.peak_dn / reading.image.mean_dn;
}

std::optional<Brightness> LightControl::brightness_of(const Camera& camera) const {
  const LightReading& reading = camera.reading;
  if (!reading.delivered) return std::nullopt;
  if (reading.dots == 0) return image_brightness(camera);
  Brightness seen;
  seen.level_dn = reading.brightest.peak_dn;
  seen.saturated_share = reading.saturated_share;
  seen.saturated =
      reading.brightest.peak_dn >= kNearFullScale_dn || reading.saturated_share > kSaturatedDots;
  seen.image_dn = reading.image.mean_dn;
  if (needs_iris(camera, settings_)) seen.tolerance = kToleranceBeforeIris;
  if (camera.iris.exercising()) seen.tolerance = kToleranceOfExercise;
  if (seen.saturated && reading.image.saturated_share < kSaturatedImage) {
    seen.level_dn = std::max(seen.level_dn, camera.dots_over_image * seen.image_dn);
  }
  return seen;
}

std::optional<Brightness> LightControl::image_brightness(const Camera& camera) const {
  const ImageLight& image = camera.reading.image;
  Brightness seen;
  seen.image_dn = image.mean_dn;
  const bool known = camera.dots_over_image > 0.0;
  seen.saturated = image.saturated_share > (known ? kSaturatedImage : kSaturatedParts);
  seen.saturated_share = seen.saturated ? 1.0 : 0.0;
  seen.level_dn = known ? camera.dots_over_image * image.mean_dn : image.high_dn;
  seen.tolerance = !known ? kToleranceOfImage : has_pose_ ? kToleranceOfUnseen : kToleranceOfLost;
  return seen;
}

Duration LightControl::longest_exposure(const Camera& camera) const {
  const double speed_px_s = camera.reading.speed_px_s;
  const double most_s = to_seconds(settings_.exposure_max);
  if (!(speed_px_s * most_s > settings_.max_blur_px)) return settings_.exposure_max;
  return std::chrono::microseconds(
      static_cast<std::int64_t>(1e6 * settings_.max_blur_px / speed_px_s));
}

// Not where the image itself says what it lacks and there is no more of it.
bool LightControl::is_spread(const Camera& camera) const {
  return searching_ticks_ > kSpreadAfter_ticks && !camera.exposure.at_most() &&
         !camera.exposure.at_least();
}

// Even the shortest exposure is too much, or the longest too little.
bool LightControl::at_end(const Camera& camera, const Brightness& seen) const {
  const double now_s = camera.exposure.product_s();
  const double least_s = to_seconds(settings_.exposure_min) * settings_.gain_min;
  const double most_s = to_seconds(settings_.exposure_max) * settings_.gain_max;
  return seen.saturated ? now_s < kNear * least_s
                        : kSpread * seen.level_dn < settings_.target_dn && kNear * now_s > most_s;
}

// Where an image in its place is off by far, the middle moves.
std::optional<ExposureSetting> LightControl::spread(std::size_t index,
                                                    const std::optional<Brightness>& seen) {
  Camera& camera = cameras_[index];
  if (seen && at_end(camera, *seen)) return camera.exposure.step(seen, settings_.exposure_max);
  const int into = searching_ticks_ - kSpreadAfter_ticks - 1;
  const int ticks = settings_.delay_ticks + 2;
  if (into % ticks != 0 || !seen) return camera.exposure.step(std::nullopt, settings_.exposure_max);
  double& middle_s = camera.searched_product_s;
  const double now_s = camera.exposure.product_s();
  if (into == 0) {
    middle_s = now_s;
  } else if (seen->saturated && now_s <= middle_s) {
    middle_s = std::max(0.3 * middle_s, to_seconds(settings_.exposure_min) * settings_.gain_min);
  } else if (!seen->saturated && seen->level_dn * kSpread < settings_.target_dn &&
             now_s >= middle_s) {
    middle_s =
        std::min(kSpread * middle_s, to_seconds(settings_.exposure_max) * settings_.gain_max);
  }
  const int place = static_cast<int>((index + static_cast<std::size_t>(into / ticks)) % kPlaces);
  const double factor = place == 0 ? 1.0 : place == 1 ? kSpread : 1.0 / kSpread;
  return camera.exposure.set_product(factor * middle_s, settings_.exposure_max);
}

std::optional<ExposureSetting> LightControl::expose(std::size_t index,
                                                    const std::optional<Brightness>& seen) {
  Camera& camera = cameras_[index];
  if (camera.refused_ticks > 0) {
    --camera.refused_ticks;
    return std::nullopt;
  }
  camera.before = camera.exposure.setting();
  if (is_spread(camera)) return spread(index, seen);
  return camera.exposure.step(seen, longest_exposure(camera));
}

bool LightControl::needs_iris(const Camera& camera, const LightSettings& settings) {
  return camera.exposure.setting().gain > kMuchGain * settings.gain_min;
}

IrisWish LightControl::wish_of(const Camera& camera, const LightSettings& settings) {
  const ExposureSetting& now = camera.exposure.setting();
  if (camera.exposure.waiting()) return IrisWish::none;
  if (camera.exposure.at_most()) return IrisWish::open;
  if (camera.exposure.at_least()) return IrisWish::close;
  if (camera.reading.dots == 0) return IrisWish::none;
  if (needs_iris(camera, settings)) {
    return camera.reading.brightest.peak_dn < kHeadroom * settings.target_dn ? IrisWish::open
                                                                             : IrisWish::none;
  }
  const bool is_short = to_seconds(now.exposure) < kShort * to_seconds(settings.exposure_min);
  return is_short ? IrisWish::close : IrisWish::none;
}

IrisLight LightControl::iris_light(const Camera& camera,
                                   const std::optional<Brightness>& seen) const {
  const double product_s = camera.exposure.product_s();
  if (!seen || camera.exposure.waiting() || !(product_s > 0.0)) return {};
  IrisLight light;
  light.steady = camera.exposure.content();
  const ImageLight& image = camera.reading.image;
  if (image.saturated_share < kSaturatedParts && image.mean_dn > kDarkImage_dn) {
    light.image = image.mean_dn / product_s;
  }
  if (camera.reading.dots == 0 || seen->saturated) return light;
  light.dots = seen->level_dn / product_s;
  light.level = seen->level_dn / settings_.target_dn;
  return light;
}

CameraOrders LightControl::decide(std::size_t index, const IrisView& iris) {
  Camera& camera = cameras_[index];
  if (!settings_.on) {
    report(camera, iris);
    return {};
  }
  const std::optional<Brightness> seen = brightness_of(camera);
  CameraOrders orders;
  orders.exposure = expose(index, seen);
  orders.iris = camera.iris.step(iris, wish_of(camera, settings_), iris_light(camera, seen),
                                 settings_.delay_ticks);
  report(camera, iris);
  return orders;
}

void LightControl::exposure_refused(std::size_t index) {
  Camera& camera = cameras_[index];
  camera.exposure.refused(camera.before);
  camera.refused_ticks = kRefused_ticks;
  camera.light.setting = camera.before;
  if (!camera.iris.present()) camera.light.state = LightState::off;
}

LightState LightControl::state_of(const Camera& camera, const LightSettings& settings) {
  if (camera.iris.fault()) return LightState::iris_fault;
  if (camera.refused_ticks > 0 && !camera.iris.present()) return LightState::off;
  if (camera.exposure.waiting()) return LightState::settling;
  const IrisWish wish = wish_of(camera, settings);
  if (camera.exposure.at_most() && camera.iris.at_end(wish)) return LightState::too_dark;
  if (camera.exposure.at_least() && camera.iris.at_end(wish)) return LightState::too_bright;
  if (camera.reading.dots == 0) return LightState::searching;
  return camera.exposure.content() ? LightState::steady : LightState::settling;
}

IrisCondition LightControl::condition_of(const Camera& camera, const IrisView& iris) {
  if (!iris.healthy || camera.iris.fault()) return IrisCondition::fault;
  if (iris.automatic || !camera.iris.present()) return IrisCondition::automatic;
  return camera.iris.ended() ? IrisCondition::at_end : IrisCondition::ok;
}

void LightControl::report(Camera& camera, const IrisView& iris) const {
  const LightReading& reading = camera.reading;
  CameraLight& light = camera.light;
  light.state = settings_.on ? state_of(camera, settings_) : LightState::off;
  light.setting = camera.exposure.setting();
  light.opening = iris.opening;
  light.iris = condition_of(camera, iris);
  const bool dots = reading.dots > 0;
  light.peak_dn = dots ? reading.brightest.peak_dn : reading.image.high_dn;
  light.contrast_dn = dots ? reading.brightest.peak_dn - reading.brightest.surround_dn
                           : reading.image.high_dn - rounded(reading.image.mean_dn);
  light.noise_dn = reading.brightest.noise_dn;
  light.saturated_px = reading.saturated_px;
  light.saturated_around_px = reading.saturated_around_px;
}

}  // namespace dottrack::exposure
