#include <fmt/format.h>

#include "app/workstation/experiments.h"

namespace dottrack::workstation {
namespace {

constexpr int kPerfect = static_cast<int>(Models::perfect);
constexpr int kCalibrated = static_cast<int>(Models::calibrated);

std::string row(const std::string& what, const std::string& paper, const std::string& perfect,
                const std::string& calibrated) {
  return fmt::format("| {:<46} | {:<22} | {:<24} | {:<24} |\n", what, paper, perfect, calibrated);
}

std::string mm(double value) {
  return fmt::format("{:.2f} mm", value);
}

std::string metres_in_mm(double value_m) {
  return mm(1000.0 * value_m);
}

// One row for both kinds of models.
template <class Figures, class Text>
std::string both(const std::string& what, const std::string& paper, const Figures (&figures)[2],
                 Text text) {
  return row(what, paper, text(figures[kPerfect]), text(figures[kCalibrated]));
}

std::string survey_rows(const Experiments& e) {
  return both("absolute: RMS over the surveyed places", "15.3 mm", e.survey,
              [](const SurveyFigures& s) {
                return fmt::format("{} ({} of {} places)", mm(s.rms_mm), s.places_found, s.places);
              }) +
         both("absolute: worst single measurement", "not given", e.survey,
              [](const SurveyFigures& s) { return mm(s.max_mm); });
}

std::string line_rows(const Experiments& e) {
  return both("straight lines: horizontal RMS", "7.6 mm", e.lines,
              [](const LineFigures& l) { return metres_in_mm(l.all.horizontal_rms_m); }) +
         both("straight lines: vertical RMS", "6.1 mm", e.lines,
              [](const LineFigures& l) { return metres_in_mm(l.all.vertical_rms_m); }) +
         both("straight lines: worst run, RMS", "12.0 mm", e.lines,
              [](const LineFigures& l) { return mm(l.worst_line_mm); }) +
         both("straight lines: worst single measurement", "61.3 mm", e.lines,
              [](const LineFigures& l) { return metres_in_mm(l.all.max_m); }) +
         both("  RMS error of these, without the dangling", "not known", e.lines,
              [](const LineFigures& l) { return mm(l.error_rms_mm); });
}

std::string acquisition_row(const AcquisitionFigures& a) {
  const char* paper = a.dots == 3 ? "a few seconds" : a.dots == 4 ? "several minutes" : "not tried";
  return row(fmt::format("acquisition of {} dots, median (worst)", a.dots), paper,
             fmt::format("{:.1f} ({:.1f}) ms", a.median_ms, a.max_ms), "") +
         row(fmt::format("  right locks of {} placements; wrong", a.lockable),
             "wrong: occasionally", fmt::format("{}; {}", a.right, a.wrong), "");
}

std::string drive_rows(const Experiments& e) {
  return both("tracking rate", "about 6 Hz", e.drive,
              [](const DriveFigures& d) { return fmt::format("{:.0f} Hz", d.rate_hz); }) +
         both("drive: ticks tracked; position RMS", "", e.drive,
              [](const DriveFigures& d) {
                return fmt::format("{} of {}; {}", d.tracked, d.ticks, mm(d.rms_mm));
              }) +
         both("25 degree ramp: ticks tracked; position RMS", "lower half worked", e.ramp,
              [](const DriveFigures& d) {
                return fmt::format("{} of {}; {}", d.tracked, d.ticks, mm(d.rms_mm));
              }) +
         both("25 degree ramp: steepest tilt tracked", "", e.ramp,
              [](const DriveFigures& d) { return fmt::format("{:.1f} degrees", d.steepest_deg); });
}

}  // namespace

std::string table_of(const Experiments& experiments) {
  std::string text = row("experiment", "paper", "perfect camera models", "calibrated models");
  text += fmt::format("|{0:-<48}|{0:-<24}|{0:-<26}|{0:-<26}|\n", "");
  text += survey_rows(experiments) + line_rows(experiments);
  for (const AcquisitionFigures& a : experiments.acquisitions) text += acquisition_row(a);
  return text + drive_rows(experiments);
}

}  // namespace dottrack::workstation
