#pragma once
// The paper's experiments (section 4) in the simulated sandbox, and what they come to.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/workstation/straightness.h"
#include "app/workstation/trials.h"
#include "app/workstation/truth_record.h"
#include "hal/base/result.h"
#include "host_sim/scenarios/scene.h"

namespace dottrack::workstation {

// What the tracker is told of its cameras.
enum class Models : std::uint8_t {
  perfect,     // the truth
  calibrated,  // of `dottrack calibrate`: from pictures of dots surveyed to a millimetre
};

// One of the paper's experiments under one kind of models. Millimetres.
struct SurveyFigures {  // a target in many places, against their survey
  std::size_t places = 0;
  std::size_t places_found = 0;
  double rms_mm = 0.0;  // over all poses
  double max_mm = 0.0;
  double attitude_rms_deg = 0.0;
};

struct LineFigures {  // a target on a crane, against straight lines
  std::vector<Straightness> lines;
  Straightness all;
  double worst_line_mm = 0.0;  // RMS
  double error_rms_mm = 0.0;   // against the truth, which dangles
};

struct DriveFigures {
  std::uint64_t ticks = 0;
  std::uint64_t tracked = 0;
  std::uint64_t wrong = 0;
  double rms_mm = 0.0;
  double steepest_deg = 0.0;  // tilt of the vehicle while it was tracked
  double rate_hz = 0.0;       // of the loop alone: one over its median time
};

SurveyFigures survey_figures(std::span<const TruthRow> rows,
                             std::span<const host_sim::Span> places);
// A line counts where the target was tracked in three ticks of it or more.
LineFigures line_figures(std::span<const TruthRow> rows, std::span<const host_sim::Span> lines);
DriveFigures drive_figures(std::span<const TruthRow> rows);

struct AcquisitionFigures {
  int dots = 0;
  std::uint64_t lockable = 0;  // placements with enough dots in two views
  std::uint64_t right = 0;     // of those
  std::uint64_t wrong = 0;     // of all
  double median_ms = 0.0;      // of the tracker, for a right lock
  double max_ms = 0.0;
};

AcquisitionFigures acquisition_figures(int dots, std::span<const Trial> trials);

struct Experiments {
  SurveyFigures survey[2];  // by Models
  LineFigures lines[2];
  DriveFigures ramp[2];
  DriveFigures drive[2];
  std::vector<AcquisitionFigures> acquisitions;  // 3, 4 and 8 dots, perfect models
};

struct ExperimentOptions {
  std::filesystem::path out;
  std::uint64_t placements = 40;  // for each number of dots
  unsigned threads = 0;           // for rendering; 0: as many as the machine has
  // Called with what is being done now; false ends the experiments with an error.
  std::function<bool(const std::string&)> go_on;
};

// Runs them all; every run leaves its results in a folder of its own in options.out.
Result<Experiments> run_experiments(const ExperimentOptions& options);

// The table, beside the paper's figures.
std::string table_of(const Experiments& experiments);

}  // namespace dottrack::workstation
