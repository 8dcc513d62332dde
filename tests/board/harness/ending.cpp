#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <string_view>
#include <thread>

#include "tests/board/harness/fault_steps.h"
#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kTestPatience = seconds(300);
constexpr int kMeasure_s = 20;

Result<std::string> end_safely(Board& board) {
  const auto ended = board.shell().check("systemctl stop dottrackd.service", seconds(120));
  if (!ended) return ended;
  std::this_thread::sleep_for(seconds(1));
  const auto messages = board.poses().from(0);
  if (messages.empty() || is_pose(messages.back())) {
    return fail("the last message on CAN still has a pose");
  }
  const std::size_t cameras = board.scene().cameras.size();
  for (std::size_t i = 0; i < cameras; ++i) {
    const IrisMechanics iris = board.gpio().iris(i);
    if (iris.overridden() || iris.enabled()) {
      return fail(fmt::format("the iris of {} is still driven", board.scene().cameras[i].name));
    }
  }
  const auto result = board.service("Result");
  if (!result) return result;
  if (*result != "success") return fail("the service ended with " + *result);
  return fmt::format("\"not tracking\" on CAN, {} irises left to themselves", cameras);
}

// `[  PASSED  ] 31 tests.`: the number after the mark; 0 when there is no such line.
std::size_t count_after(const std::string& text, std::string_view mark) {
  const auto at = text.find(mark);
  if (at == std::string::npos) return 0;
  std::size_t count = 0;
  const char* first = text.data() + at + mark.size();
  std::from_chars(first, text.data() + text.size(), count);
  return count;
}

Result<std::string> run_hardware_tests(Board& board) {
  const auto output = board.shell().run(
      "cd /run/observer && ./bin/hardware_test >/run/hardware_test.log 2>&1; status=$?; "
      "grep -E '^\\[  (PASSED|SKIPPED|FAILED )  ?\\] ' /run/hardware_test.log; "
      "systemd-cat -t hardware_test cat /run/hardware_test.log; "
      "(exit $status)",
      kTestPatience);
  if (!output) return tl::unexpected(output.error());
  const std::size_t passed = count_after(output->text, "[  PASSED  ] ");
  const std::size_t skipped = count_after(output->text, "[  SKIPPED ] ");
  const std::string figures = fmt::format("{} passed, {} skipped", passed, skipped);
  if (output->status != 0 || passed == 0) {
    return fail(fmt::format("status {}; {}; {}", output->status, figures, output->text));
  }
  return figures;
}

// The middle column of a row of `dottrackd --measure`: count, min, p50, ...
Result<double> median_ms(const std::string& text, std::string_view row) {
  const auto at = text.find(row);
  double count = 0.0;
  double least = 0.0;
  double median_us = 0.0;
  if (at == std::string::npos ||
      std::sscanf(text.c_str() + at + row.size(), "%lf %lf %lf", &count, &least, &median_us) != 3) {
    return fail(fmt::format("dottrackd --measure printed no row \"{}\"", row));
  }
  return median_us / 1000.0;
}

// An emulated processor has the host's jitter: times are told, not judged. What a loop may never do
// is: touch the heap, lose a record.
Result<std::string> measure(Board& board) {
  const auto output = board.shell().check(
      fmt::format("dottrackd --config /etc/dottrack/rig.toml --measure {} 2>/run/measure.log",
                  kMeasure_s),
      seconds(kMeasure_s + 120));
  if (!output) return output;
  const auto wake = median_ms(*output, "wake-up latency ");
  if (!wake) return tl::unexpected(wake.error());
  const auto age = median_ms(*output, "age of a pose at its CAN frame ");
  if (!age) return tl::unexpected(age.error());
  constexpr std::string_view kClean = "records dropped 0, heap calls in the loop 0";
  if (output->find(kClean) == std::string::npos) {
    return fail(fmt::format("expected \"{}\" in {}", kClean, *output));
  }
  return fmt::format(
      "0 heap calls, {} ticks missed; medians: wake-up {:.2f} ms late, poses {:.0f} ms "
      "old at their CAN frames",
      count_after(*output, "ticks missed "), *wake, *age);
}

}  // namespace

Finding told_to_end(Board& board) {
  return conclude("told to end (SIGTERM)", end_safely(board));
}

Finding measuring(Board& board) {
  return conclude("dottrackd --measure", measure(board));
}

Finding hardware_tests(Board& board) {
  return conclude("drivers' tests in the guest", run_hardware_tests(board));
}

}  // namespace dottrack::board
