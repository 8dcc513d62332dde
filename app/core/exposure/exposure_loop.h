#pragma once
// One camera's exposure time and gain, from how bright its dots are.

#include <optional>

#include "app/core/exposure/light_settings.h"

namespace dottrack::exposure {

struct Brightness {
  double level_dn = 0.0;         // of the brightest dot; beyond full scale where it is estimated
  bool saturated = false;        // more than a pixel or two of the dots are at full scale
  double saturated_share = 0.0;  // of the dots' pixels
  double image_dn = 0.0;         // mean of the whole image
  double tolerance = 1.15;       // that the level may be off, as a ratio, before anything is done
};

// Grey levels are proportional to exposure time times gain as long as they are below full scale, so
// one change does it: the product times what the level lacks. Its share of the exposure time is as
// long as it may be, the rest is gain. There is nothing to wind up: a product is always the one
// last set times a ratio. After a change nothing else is done until its effect is seen, at half of
// what it should be, or delay_ticks are over.
class ExposureLoop {
 public:
  ExposureLoop() = default;
  ExposureLoop(const LightSettings& settings, const ExposureSetting& start)
      : settings_(&settings), setting_(start) {}

  // Once a tick. What to set now, if anything. `longest`: what the dots' motion allows.
  std::optional<ExposureSetting> step(const std::optional<Brightness>& seen, Duration longest);
  // The same with the product given, unless a change is on its way.
  std::optional<ExposureSetting> set_product(double product_s, Duration longest);
  // The camera did not take it.
  void refused(const ExposureSetting& before) {
    setting_ = before;
    waiting_ = false;
  }

  const ExposureSetting& setting() const { return setting_; }
  double product_s() const { return to_seconds(setting_.exposure) * setting_.gain; }
  bool waiting() const { return waiting_; }
  // In the last tick the level was off, and nothing could be done about it.
  bool at_most() const { return at_most_; }
  bool at_least() const { return at_least_; }
  // In the last tick the level was as it should be.
  bool content() const { return content_; }

 private:
  bool effect_is_due(const Brightness& seen) const;
  bool wait_on(const std::optional<Brightness>& seen);
  double ratio_for(const Brightness& seen) const;
  bool is_to_change(double ratio, const Brightness& seen);
  bool badly_split(Duration longest) const;
  ExposureSetting split(double product_s, Duration longest) const;
  std::optional<ExposureSetting> change(const ExposureSetting& next, const Brightness& seen);

  const LightSettings* settings_ = nullptr;
  ExposureSetting setting_;
  bool waiting_ = false;
  int waited_ticks_ = 0;
  double expected_ratio_ = 1.0;  // of the change on its way
  Brightness before_;            // the change
  int off_ticks_ = 0;            // one after another that the level was off
  bool at_most_ = false;
  bool at_least_ = false;
  bool content_ = false;
};

}  // namespace dottrack::exposure
