#pragma once
// What the benchmarks say in terms of the yardstick and of OpenCV: a table after the runs.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dottrack::bench {

// Collects the processor time of every benchmark, the least of its repetitions: what else the
// machine does only adds to it. Prints nothing until all have run.
class RatioTable : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  bool any_failed() const { return failed_; }

 private:
  // In the order of registration, whatever the order of the runs.
  using Place = std::pair<std::int64_t, std::int64_t>;

  double time_us(const std::string& name) const;
  void print_row(const std::string& name, double us) const;
  void print_comparisons() const;
  void print_goals() const;
  void print_brute_force() const;
  void print_rate(const std::string& name, const char* what) const;

  std::map<Place, std::string> names_;
  std::map<std::string, double> time_us_;
  bool failed_ = false;
};

}  // namespace dottrack::bench
