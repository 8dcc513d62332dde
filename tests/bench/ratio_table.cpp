#include "tests/bench/ratio_table.h"

#include <algorithm>
#include <cstdio>

namespace dottrack::bench {
namespace {

// These use all cores: their measure is real time.
bool is_simulation(const std::string& name) {
  return name.starts_with("sim/");
}

}  // namespace

bool RatioTable::ReportContext(const Context& /*context*/) {
  return true;
}

void RatioTable::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const std::string name = run.run_name.str();
    if (run.error_occurred) {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), run.error_message.c_str());
      failed_ = true;
      continue;
    }
    if (run.run_type != Run::RT_Iteration) continue;
    const double seconds =
        is_simulation(name) ? run.real_accumulated_time : run.cpu_accumulated_time;
    const double us = 1e6 * seconds / static_cast<double>(run.iterations);
    names_[{run.family_index, run.per_family_instance_index}] = name;
    double& least = time_us_.try_emplace(name, us).first->second;
    least = std::min(least, us);
  }
}

double RatioTable::time_us(const std::string& name) const {
  const auto found = time_us_.find(name);
  return found == time_us_.end() ? 0.0 : found->second;
}

void RatioTable::print_row(const std::string& name, double us) const {
  const double s = time_us("byte_sum");
  if (s > 0.0) {
    std::printf("%-36s %12.3f %10.3f\n", name.c_str(), us, us / s);
  } else {
    std::printf("%-36s %12.3f\n", name.c_str(), us);
  }
}

void RatioTable::print_comparison(const std::string& opencv, const std::string& ours) const {
  const double theirs_us = time_us(opencv);
  const double ours_us = time_us(ours);
  if (theirs_us <= 0.0 || ours_us <= 0.0) return;
  std::printf("%-36s %8.1f x %s\n", opencv.c_str(), theirs_us / ours_us, ours.c_str());
}

void RatioTable::Finalize() {
  std::printf("%-36s %12s %10s\n", "", "us", "byte_sums");
  for (const auto& [place, name] : names_) {
    if (!is_simulation(name)) print_row(name, time_us(name));
  }
  std::printf("\n");
  print_brute_force();
  print_rate("sim/drive_tick", "simulated ticks, 12 cameras");
  print_rate("sim/acquisition", "simulated acquisitions, 12 cameras");
  for (const char* scene : {"sparse", "heavy"}) {
    const std::string ours = std::string("identify/") + scene;
    print_comparison(std::string("opencv/contours/") + scene, ours);
    print_comparison(std::string("opencv/connected_components/") + scene, ours);
  }
}

void RatioTable::print_brute_force() const {
  const double thousandth_us = time_us("select_brute_force/4/200/a_thousandth_of_it");
  const double ours_us = time_us("select/4/200");
  if (thousandth_us <= 0.0 || ours_us <= 0.0) return;
  std::printf("%-36s %8.0f x select/4/200 (1000 times a timed thousandth)\n",
              "select_brute_force/4/200", 1000.0 * thousandth_us / ours_us);
}

void RatioTable::print_rate(const std::string& name, const char* what) const {
  const auto found = time_us_.lower_bound(name);  // its full name says how it was measured, too
  if (found == time_us_.end() || !found->first.starts_with(name)) return;
  std::printf("%-36s %8.1f a second\n", what, 1e6 / found->second);
}

}  // namespace dottrack::bench
