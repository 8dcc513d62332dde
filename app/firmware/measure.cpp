#include "app/firmware/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dottrack::firmware {
namespace {

double microseconds(Duration d) {
  return static_cast<double>(d.count()) * 1e-3;
}

// Of sorted, non-empty values: the smallest that a share of them does not exceed.
double percentile(const std::vector<double>& sorted, double share) {
  const double place = std::ceil(share * static_cast<double>(sorted.size())) - 1.0;
  return sorted[static_cast<std::size_t>(std::max(0.0, place))];
}

}  // namespace

void Measure::do_write(const telemetry::CycleRecord& record) {
  wake_.us.push_back(microseconds(record.woke - record.due));
  capture_.us.push_back(microseconds(record.stages.capture));
  track_.us.push_back(microseconds(record.stages.track));
  broadcast_.us.push_back(microseconds(record.stages.broadcast));
  expose_.us.push_back(microseconds(record.stages.expose));
  record_.us.push_back(microseconds(record.stages.record));
  cycle_.us.push_back(microseconds(record.stages.cycle()));
  if (record.result.has_pose) age_.us.push_back(microseconds(record.sent - record.stamp));
  counters_ = record.counters;
}

std::string Measure::row(const Quantity& quantity) {
  if (quantity.us.empty()) return fmt::format("{:32} {:>9}\n", quantity.name, "none");
  std::vector<double> us = quantity.us;
  std::sort(us.begin(), us.end());
  return fmt::format("{:32} {:9} {:10.1f} {:10.1f} {:10.1f} {:10.1f} {:10.1f}\n", quantity.name,
                     us.size(), us.front(), percentile(us, 0.5), percentile(us, 0.99),
                     percentile(us, 0.999), us.back());
}

// One line a power of two of microseconds.
std::string Measure::histogram(const Quantity& quantity) {
  constexpr int kBins = 28;
  constexpr double kWidth = 50.0;
  std::vector<int> counts(kBins, 0);
  for (const double us : quantity.us) {
    const int bin = us < 1.0 ? 0 : 1 + static_cast<int>(std::floor(std::log2(us)));
    ++counts[static_cast<std::size_t>(std::min(bin, kBins - 1))];
  }
  const int most = *std::max_element(counts.begin(), counts.end());
  std::string text = fmt::format("\n{}, us\n", quantity.name);
  for (int bin = 0; bin < kBins; ++bin) {
    const int count = counts[static_cast<std::size_t>(bin)];
    if (count == 0) continue;
    const auto bar = static_cast<std::size_t>(std::ceil(kWidth * count / most));
    text += fmt::format("  below {:>9} {:>9} {}\n", std::int64_t{1} << bin, count,
                        std::string(bar, '#'));
  }
  return text;
}

std::string Measure::report(std::uint64_t heap_calls) const {
  std::string text = fmt::format("{:32} {:>9} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "us", "count",
                                 "min", "p50", "p99", "p99.9", "max");
  for (const Quantity* quantity :
       {&wake_, &capture_, &track_, &broadcast_, &expose_, &record_, &cycle_, &age_}) {
    text += row(*quantity);
  }
  for (const Quantity* quantity : {&wake_, &cycle_, &age_}) text += histogram(*quantity);
  return text + fmt::format(
                    "\nticks missed {}, messages not sent {}, records dropped {}, heap calls "
                    "in the loop {}\n",
                    counters_.deadline_misses,
                    counters_.sends_failed + counters_.sends_without_room,
                    counters_.records_dropped, heap_calls);
}

}  // namespace dottrack::firmware
