#include "app/workstation/calibrate/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "app/workstation/json_object.h"

namespace dottrack::calibrate {
namespace {

using workstation::json_string;
using workstation::JsonObject;

std::size_t used(const CameraCalibration& camera) {
  return static_cast<std::size_t>(
      std::count_if(camera.residuals.begin(), camera.residuals.end(),
                    [](const ResidualOfView& residual) { return residual.used; }));
}

std::string strings(std::span<const std::string> lines, const std::string& indent) {
  std::string text = "[";
  for (const std::string& line : lines) {
    text += fmt::format("{}\n{}  {}", text.size() > 1 ? "," : "", indent, json_string(line));
  }
  return text + (lines.empty() ? "]" : "\n" + indent + "]");
}

std::string camera_json(const CameraCalibration& camera) {
  JsonObject object(2);
  object.add("name", json_string(camera.name));
  object.add("model", json_string(to_string(camera.chosen)));
  object.add("dots", camera.residuals.size());
  object.add("dots_used", used(camera));
  object.add("rms_px", camera.rms_px);
  object.add("rms_adjusted_px", camera.rms_adjusted_px);
  object.add("holdout_rms_px", camera.holdout_rms_px);
  object.add("image_sigma_px", camera.image_sigma_px);
  object.add("coverage", camera.coverage);
  object.add("place_sigma_m", camera.sigmas.place_m);
  object.add("pointing_sigma_rad", camera.sigmas.pointing_rad);
  object.add("roll_sigma_rad", camera.sigmas.roll_rad);
  object.add("scale_sigma", camera.sigmas.scale);
  object.add("centre_sigma_px", camera.sigmas.centre_px);
  object.add("remarks", strings(camera.remarks, "      "));
  return object.text();
}

std::string suspect_json(const SuspectDot& suspect) {
  JsonObject object(2);
  object.add("dot", json_string(suspect.name));
  object.add("off_m",
             fmt::format("[{}, {}, {}]", suspect.off_m.x(), suspect.off_m.y(), suspect.off_m.z()));
  object.add("sigmas", suspect.sigmas);
  return object.text();
}

template <class Items, class Text>
std::string list(const Items& items, Text text) {
  std::string all = "[";
  for (const auto& item : items)
    all += fmt::format("{}\n    {}", all.size() > 1 ? "," : "", text(item));
  return all + (items.empty() ? "]" : "\n  ]");
}

}  // namespace

std::string residuals_csv(std::span<const SurveyedDot> dots, const Calibration& calibration) {
  std::string text = "camera,dot,tick,x_px,y_px,off_x_px,off_y_px,holdout_x_px,holdout_y_px,used\n";
  for (const CameraCalibration& camera : calibration.cameras) {
    for (const ResidualOfView& r : camera.residuals) {
      const SurveyedDot& dot = dots[r.dot];
      fmt::format_to(std::back_inserter(text),
                     "{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", camera.name,
                     dot.name, dot.tick ? fmt::format("{}", *dot.tick) : "", r.pixel.x(),
                     r.pixel.y(), r.off_px.x(), r.off_px.y(), r.holdout_px.x(), r.holdout_px.y(),
                     r.used ? 1 : 0);
    }
  }
  return text;
}

std::string figures_json(std::span<const SurveyedDot> dots, const Calibration& calibration,
                         const std::optional<HalfFigures>& tested,
                         std::span<const std::string> remarks) {
  JsonObject report(0);
  report.add("surveyed_dots", dots.size());
  report.add("holdout_rms_px", calibration.holdout_rms_px);
  report.add("holdout_rms_m", calibration.holdout_rms_m);
  report.add("holdout_dots", calibration.holdout_dots);
  report.add("survey_scale", calibration.survey_scale);
  if (tested) {
    JsonObject test(1);
    test.add("rms_px", tested->rms_px);
    test.add("observations", tested->observations);
    test.add("rms_m", tested->rms_m);
    test.add("triangulated_dots", tested->triangulated);
    report.add("test", test.text());
  }
  report.add("cameras", list(calibration.cameras, camera_json));
  report.add("suspect_dots", list(calibration.suspects, suspect_json));
  report.add("remarks", strings(remarks, "  "));
  return report.text() + "\n";
}

std::string figures_table(const Calibration& calibration, const std::optional<HalfFigures>& tested,
                          std::span<const std::string> remarks) {
  std::string text =
      fmt::format("{:<14} {:<26} {:>10} {:>8} {:>12} {:>10} {:>11}\n", "camera", "model",
                  "dots used", "rms px", "held out px", "place mm", "pointing deg");
  for (const CameraCalibration& camera : calibration.cameras) {
    text += fmt::format("{:<14} {:<26} {:>10} {:>8.3f} {:>12.3f} {:>10.2f} {:>11.4f}\n",
                        camera.name, to_string(camera.chosen),
                        fmt::format("{}/{}", used(camera), camera.residuals.size()), camera.rms_px,
                        camera.holdout_rms_px, 1e3 * camera.sigmas.place_m,
                        camera.sigmas.pointing_rad * 180.0 / std::numbers::pi);
  }
  text += fmt::format("held out: {:.3f} px", calibration.holdout_rms_px);
  if (calibration.holdout_dots > 0) {
    text += fmt::format(", {:.3f} mm in 3-D ({} dots)", 1e3 * calibration.holdout_rms_m,
                        calibration.holdout_dots);
  }
  text += "\n";
  if (tested) {
    text += fmt::format(
        "tested on the dots not used: {:.4f} px rms of {}, {:.4f} mm rms in 3-D of {}\n",
        tested->rms_px, tested->observations, 1e3 * tested->rms_m, tested->triangulated);
  }
  for (const SuspectDot& suspect : calibration.suspects) {
    text +=
        fmt::format("wrongly surveyed? dot {}: off by ({:.1f}, {:.1f}, {:.1f}) mm, {:.1f} sigmas\n",
                    suspect.name, 1e3 * suspect.off_m.x(), 1e3 * suspect.off_m.y(),
                    1e3 * suspect.off_m.z(), suspect.sigmas);
  }
  for (const std::string& remark : remarks) text += fmt::format("note: {}\n", remark);
  for (const std::string& remark : calibration.remarks) text += fmt::format("note: {}\n", remark);
  for (const CameraCalibration& camera : calibration.cameras) {
    for (const std::string& remark : camera.remarks) {
      text += fmt::format("note: camera \"{}\": {}\n", camera.name, remark);
    }
  }
  return text;
}

}  // namespace dottrack::calibrate
