#include "app/workstation/calibrate/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "app/workstation/calibrate/report/drawings.h"
#include "app/workstation/calibrate/report/error_map.h"
#include "app/workstation/xml_text.h"

namespace dottrack::calibrate {
namespace {

using workstation::escaped;

constexpr const char* kStyle =
    "body{font-family:sans-serif;color:#222;max-width:1100px;margin:24px auto;padding:0 16px}"
    "table{border-collapse:collapse;margin:10px 0}th,td{border:1px solid #ccc;padding:3px 9px;"
    "text-align:right}th{background:#f0f0f0}th:first-child,td:first-child{text-align:left}"
    ".cameras{display:flex;flex-wrap:wrap;gap:24px}.camera{width:470px}"
    ".remark{color:#8a5200}h2{margin-top:34px}h3{margin-bottom:4px}.chosen{font-weight:bold}";

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

std::string list_of(const std::vector<std::string>& remarks) {
  if (remarks.empty()) return "";
  std::string out = "<ul>\n";
  for (const std::string& r : remarks) {
    out += fmt::format("<li class='remark'>{}</li>\n", escaped(r));
  }
  return out + "</ul>\n";
}

std::string summary(const Calibration& c, std::span<const SurveyedDot> dots) {
  std::size_t seen = 0;
  for (const AdjustedPlace& place : c.dots) seen += place.views > 0 ? 1 : 0;
  std::string out = fmt::format("<p>{} cameras, {} surveyed dots, {} of them seen. ",
                                c.cameras.size(), dots.size(), seen);
  out += fmt::format(
      "On dots left out of the fit: <b>{:.3f} px</b> RMS in the images to the surveyed places",
      c.holdout_rms_px);
  if (c.holdout_dots > 0) {
    out += fmt::format(", <b>{}</b> RMS in space ({} dots triangulated)",
                       length_words(c.holdout_rms_m), c.holdout_dots);
  }
  out += fmt::format(". The survey is {:.2g} times as uncertain as it was taken to be.</p>\n",
                     c.survey_scale);
  return out + list_of(c.remarks);
}

std::string camera_rows(const Calibration& calibration) {
  std::string out =
      "<table>\n<tr><th>camera</th><th>model</th><th>views</th><th>left out</th><th>RMS, px</th>"
      "<th>to adjusted dots, px</th><th>on dots left out, px</th><th>noise, px</th>"
      "<th>image covered</th></tr>\n";
  for (const CameraCalibration& c : calibration.cameras) {
    const auto left_out = std::count_if(c.residuals.begin(), c.residuals.end(),
                                        [](const ResidualOfView& r) { return !r.used; });
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.3f}</td>"
        "<td>{:.3f}</td><td>{:.3f}</td><td>{:.0f} %</td></tr>\n",
        escaped(c.name), to_string(c.chosen), c.residuals.size(), left_out, c.rms_px,
        c.rms_adjusted_px, c.holdout_rms_px, c.image_sigma_px, 100.0 * c.coverage);
  }
  return out + "</table>\n";
}

std::string sigma_rows(const Calibration& calibration) {
  std::string out =
      "<table>\n<tr><th>camera</th><th>x, m</th><th>y, m</th><th>z, m</th><th>place</th>"
      "<th>pointing, deg</th><th>roll, deg</th><th>scale, %</th><th>centre, px</th></tr>\n";
  for (const CameraCalibration& c : calibration.cameras) {
    const Eigen::Vector3d& place = geometry::centre(c.model);
    out += fmt::format(
        "<tr><td>{}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{}</td><td>{:.4f}</td>"
        "<td>{:.4f}</td><td>{:.4f}</td><td>{:.2f}</td></tr>\n",
        escaped(c.name), place.x(), place.y(), place.z(), length_words(c.sigmas.place_m),
        degrees(c.sigmas.pointing_rad), degrees(c.sigmas.roll_rad), 100.0 * c.sigmas.scale,
        c.sigmas.centre_px);
  }
  return out + "</table>\n";
}

std::string suspect_rows(const Calibration& calibration) {
  if (calibration.suspects.empty()) return "<p>None.</p>\n";
  std::string out =
      "<table>\n<tr><th>dot</th><th>off</th><th>dx, mm</th><th>dy, mm</th><th>dz, mm</th>"
      "<th>standard deviations</th><th>views</th></tr>\n";
  for (const SuspectDot& s : calibration.suspects) {
    out += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f}</td>"
        "<td>{}</td></tr>\n",
        escaped(s.name), length_words(s.off_m.norm()), 1e3 * s.off_m.x(), 1e3 * s.off_m.y(),
        1e3 * s.off_m.z(), s.sigmas, calibration.dots[s.dot].views);
  }
  return out + "</table>\n";
}

std::string tried_rows(const CameraCalibration& c) {
  if (c.tried.empty()) return "";
  std::string out =
      "<table>\n<tr><th>tried</th><th>numbers</th><th>on dots left out, px</th></tr>\n";
  for (const TriedModel& t : c.tried) {
    out += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                       t.chosen ? " class='chosen'" : "", escaped(t.name), t.numbers,
                       std::isfinite(t.holdout_rms_px) ? fmt::format("{:.3f}", t.holdout_rms_px)
                                                       : std::string("does not fit"));
  }
  return out + "</table>\n";
}

std::string camera_part(const CameraCalibration& c, const Calibration& calibration) {
  return fmt::format("<div class='camera'>\n<h3>{}</h3>\n{}{}{}</div>\n", escaped(c.name),
                     residual_drawing(c, calibration.suspects), list_of(c.remarks), tried_rows(c));
}

double median_height_m(std::span<const SurveyedDot> dots) {
  std::vector<double> heights;
  for (const SurveyedDot& dot : dots) heights.push_back(dot.position_m.z());
  if (heights.empty()) return 0.0;
  std::sort(heights.begin(), heights.end());
  return heights[heights.size() / 2];
}

std::string map_part(const Calibration& calibration, std::span<const SurveyedDot> dots,
                     const ReportRequest& request) {
  const double height_m = request.map_height_m.value_or(median_height_m(dots));
  const ErrorMap map = error_map(calibration, dots, height_m);
  if (map.worst_m() <= 0.0) return "<p>No place is seen by two cameras.</p>\n";
  return fmt::format(
      "<p>A dot {:.3g} m high, seen by all cameras that have it in their image: median {}, worst "
      "{}. "
      "Noise of the images and uncertainty of the models, with what they have in common from the "
      "survey. Grey: fewer than two cameras.</p>\n{}",
      height_m, length_words(map.median_m()), length_words(map.worst_m()),
      map_drawing(map, calibration));
}

}  // namespace

std::string report_html(const Calibration& calibration, std::span<const SurveyedDot> dots,
                        const ReportRequest& request) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'/>\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      escaped(request.title), kStyle);
  out += summary(calibration, dots) + list_of(request.remarks);
  out += "<h2>Cameras</h2>\n" + camera_rows(calibration);
  out += "<h2>Uncertainty</h2>\n<p>One standard deviation.</p>\n" + sigma_rows(calibration);
  out +=
      "<h2>Suspect dots</h2>\n<p>Surveyed elsewhere than the cameras see them; their surveyed "
      "places were not used.</p>\n" +
      suspect_rows(calibration);
  out += "<h2>Expected error in space</h2>\n" + map_part(calibration, dots, request);
  out +=
      "<h2>Residuals</h2>\n<p>From where each dot was seen to where its surveyed place would "
      "show. Red: left out; orange: suspect dot. Green: the part of the image that dots fill.</p>"
      "\n<div class='cameras'>\n";
  for (const CameraCalibration& c : calibration.cameras) out += camera_part(c, calibration);
  return out + "</div>\n</body>\n</html>\n";
}

}  // namespace dottrack::calibrate
