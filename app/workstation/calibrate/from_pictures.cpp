#include "app/workstation/calibrate/from_pictures.h"

#include <system_error>
#include <utility>

#include "app/telemetry/output_file.h"
#include "app/workstation/calibrate/halves.h"
#include "app/workstation/calibrate/input/survey_file.h"
#include "app/workstation/calibrate/report/report.h"
#include "app/workstation/calibrate/report/rig_files.h"
#include "app/workstation/loop_files.h"

namespace dottrack::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr double kObserving = 0.3;  // of the whole job: finding the dots

// Of another kind than the new ones: a later run would find two models of a camera.
void remove_older_models(const fs::path& folder, const Calibration& calibration) {
  std::error_code ignored;
  for (const CameraCalibration& camera : calibration.cameras) {
    for (const char* kind : {".cahv", ".cahvor", ".cahvore"}) {
      fs::remove(folder / (camera.name + kind), ignored);
    }
  }
}

}  // namespace

Result<PictureCalibration> calibrate_pictures(const PictureRequest& request) {
  const auto go_on = [&](double part) { return !request.go_on || request.go_on(part); };
  PictureCalibration done;
  auto dots = read_survey(request.dots);
  if (!dots) return tl::unexpected<Error>(dots.error());
  done.dots = std::move(*dots);
  const auto inputs = read_inputs(request.inputs, done.dots);
  if (!inputs) return tl::unexpected<Error>(inputs.error());
  ObserveOptions observing = request.observe;
  observing.progress = [&](double part) { static_cast<void>(go_on(kObserving * part)); };
  auto observed = observe(done.dots, *inputs, observing);
  if (!observed) return tl::unexpected<Error>(observed.error());
  done.remarks = std::move(observed->remarks);
  CalibrationOptions options = request.calibrate;
  options.progress = [&](double part, const std::string&) {
    return go_on(kObserving + (1.0 - kObserving) * part);
  };
  const auto views = request.fit ? half_of(observed->views, *request.fit) : observed->views;
  auto calibration = calibrate(done.dots, views, options);
  if (!calibration) return tl::unexpected<Error>(calibration.error());
  done.calibration = std::move(*calibration);
  if (request.test) {
    done.tested = figures_of(done.dots, observed->views, done.calibration, *request.test);
  }
  return done;
}

Result<void> write_calibration(const PictureCalibration& done, const fs::path& target,
                               const fs::path& folder) {
  if (auto made = workstation::make_folder(folder); !made) return made;
  RigRequest rig;
  if (!target.empty()) rig.target = target;
  auto files = rig_files(done.calibration, rig);
  if (!files) return tl::unexpected<Error>(files.error());
  ReportRequest report;
  report.remarks = done.remarks;
  files->push_back({"report.html", report_html(done.calibration, done.dots, report)});
  files->push_back({"residuals.csv", residuals_csv(done.dots, done.calibration)});
  files->push_back(
      {"report.json", figures_json(done.dots, done.calibration, done.tested, done.remarks)});
  remove_older_models(folder, done.calibration);
  for (const RigFile& file : *files) {
    if (auto written = telemetry::write_file(folder / file.name, file.text); !written) {
      return written;
    }
  }
  return {};
}

}  // namespace dottrack::calibrate
