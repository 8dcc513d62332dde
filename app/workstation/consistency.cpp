#include "app/workstation/consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/workstation/loop_files.h"
#include "app/workstation/sim_run.h"
#include "host_sim/scenarios/scenario_file.h"
#include "host_sim/scenarios/scene_renderer.h"

namespace dottrack::workstation {
namespace {

constexpr double kInside95 = 12.592;  // of chi squared with six degrees of freedom

HallRun figures_of(const std::string& scenario, std::uint64_t hall,
                   std::span<const TruthRow> rows) {
  std::vector<PoseError> raw;
  std::vector<PoseError> filtered;
  for (const TruthRow& row : rows) {
    if (row.error) raw.push_back(*row.error);
    if (row.filtered_error) filtered.push_back(*row.filtered_error);
  }
  return {scenario, hall, consistency_of(raw), consistency_of(filtered)};
}

Result<HallRun> run_hall(const ConsistencyOptions& options, const ConsistencyOptions::Part& part,
                         std::uint64_t hall) {
  const auto file = host_sim::find_scenario(part.scenario);
  if (!file) return tl::unexpected<Error>(file.error());
  auto scene = host_sim::load_scenario(*file, {.seed = hall, .layout_seed = hall});
  if (!scene) return tl::unexpected<Error>(scene.error());
  scene->ticks = std::min(scene->ticks, part.ticks);
  host_sim::SceneRenderer renderer(*scene, options.threads);
  SimOptions sim;
  sim.out = options.out / fmt::format("{}_{}", scene->name, hall);
  sim.pictures = false;
  sim.go_on = [&](std::uint64_t done) {
    return !options.go_on ||
           options.go_on(fmt::format("{}, hall {} of {}: tick {} of {}", scene->name, hall,
                                     options.halls, done, scene->ticks));
  };
  const auto run = simulate(*scene, renderer, sim);
  if (!run) return tl::unexpected<Error>(run.error());
  if (!run->loop.output_fault.empty()) return fail(run->loop.output_fault);
  if (run->rows.size() < run->ticks_asked) return fail("stopped before all halls were done");
  return figures_of(scene->name, hall, run->rows);
}

// Over halls that have a pose.
struct Mean {
  double value = 0.0;
  double sigma = 0.0;  // of the mean
};

template <class Figure>
Mean mean_of(std::span<const HallRun> runs, Figure figure) {
  double sum = 0.0;
  double squares = 0.0;
  double n = 0.0;
  for (const HallRun& run : runs) {
    const double value = figure(run);
    sum += value;
    squares += value * value;
    n += 1.0;
  }
  const double mean = sum / n;
  const double variance = n > 1.0 ? std::max(squares / n - mean * mean, 0.0) * n / (n - 1.0) : 0.0;
  return {mean, std::sqrt(variance / n)};
}

std::string row(const std::string& scenario, std::span<const HallRun> runs, const char* kind,
                Consistency HallRun::*which) {
  std::vector<HallRun> with_pose;
  std::uint64_t poses = 0;
  for (const HallRun& run : runs) {
    if (run.scenario != scenario || (run.*which).poses == 0) continue;
    with_pose.push_back(run);
    poses += (run.*which).poses;
  }
  if (with_pose.empty()) return fmt::format("| {:<12} | {:<8} | no poses |\n", scenario, kind);
  const Mean nees = mean_of(with_pose, [&](const HallRun& run) { return (run.*which).nees_mean; });
  const Mean inside = mean_of(with_pose, [&](const HallRun& run) { return (run.*which).inside; });
  const Mean square = mean_of(with_pose, [&](const HallRun& run) {
    return (run.*which).position_rms_mm * (run.*which).position_rms_mm;
  });
  return fmt::format(
      "| {:<12} | {:<8} | {:>5} | {:>6} | {:>5.2f} mm | {:>5.2f} +- {:.2f} | {:>5.1f} % |\n",
      scenario, kind, with_pose.size(), poses, std::sqrt(square.value), nees.value, nees.sigma,
      100.0 * inside.value);
}

}  // namespace

Consistency consistency_of(std::span<const PoseError> errors) {
  Consistency sum;
  for (const PoseError& error : errors) {
    ++sum.poses;
    sum.position_rms_mm += error.position_mm() * error.position_mm();
    sum.nees_mean += error.nees;
    sum.inside += error.nees <= kInside95 ? 1.0 : 0.0;
  }
  if (sum.poses == 0) return sum;
  const auto count = static_cast<double>(sum.poses);
  sum.position_rms_mm = std::sqrt(sum.position_rms_mm / count);
  sum.nees_mean /= count;
  sum.inside /= count;
  return sum;
}

Result<std::vector<HallRun>> run_halls(const ConsistencyOptions& options) {
  if (const auto made = make_folder(options.out); !made) return tl::unexpected<Error>(made.error());
  std::vector<HallRun> runs;
  for (const ConsistencyOptions::Part& part : options.parts) {
    for (std::uint64_t hall = 1; hall <= options.halls; ++hall) {
      auto run = run_hall(options, part, hall);
      if (!run) return tl::unexpected<Error>(run.error());
      runs.push_back(std::move(*run));
    }
  }
  return runs;
}

std::string consistency_table(std::span<const HallRun> runs) {
  std::string text =
      "| scenario     | pose     | halls | poses  | RMS      | squared error | within  |\n"
      "|--------------|----------|-------|--------|----------|---------------|---------|\n";
  std::vector<std::string> scenarios;
  for (const HallRun& run : runs) {
    if (scenarios.empty() || scenarios.back() != run.scenario) scenarios.push_back(run.scenario);
  }
  for (const std::string& scenario : scenarios) {
    text += row(scenario, runs, "raw", &HallRun::raw);
    text += row(scenario, runs, "filtered", &HallRun::filtered);
  }
  return text;
}

std::string consistency_csv(std::span<const HallRun> runs) {
  std::string text = "scenario,hall,pose,poses,position_rms_mm,nees_mean,inside_95\n";
  for (const HallRun& run : runs) {
    const auto line = [&](const char* kind, const Consistency& of) {
      text += fmt::format("{},{},{},{},{:.4f},{:.4f},{:.4f}\n", run.scenario, run.hall, kind,
                          of.poses, of.position_rms_mm, of.nees_mean, of.inside);
    };
    line("raw", run.raw);
    line("filtered", run.filtered);
  }
  return text;
}

}  // namespace dottrack::workstation
