#include "app/firmware/measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dottrack::firmware {
namespace {

using std::chrono::microseconds;
using testing::HasSubstr;

telemetry::CycleRecord record_of(int n) {
  telemetry::CycleRecord record;
  record.due = Time(microseconds(1000 * n));
  record.woke = record.due + microseconds(n);
  record.stages.track = microseconds(2 * n);
  record.stages.broadcast = microseconds(n);
  record.result.has_pose = n % 2 == 0;
  record.stamp = record.due - microseconds(500);
  record.sent = record.due + microseconds(100);
  return record;
}

TEST(Measure, KnowsTheExtremesAndTheMiddle) {
  Measure measure;
  for (int n = 1; n <= 1000; ++n) measure.write(record_of(n));
  const std::string report = measure.report(3);
  EXPECT_THAT(report, HasSubstr("wake-up latency                       1000        1.0      500.0"
                                "      990.0      999.0     1000.0\n"));
  EXPECT_THAT(report, HasSubstr("whole tick                            1000        3.0     1500.0"
                                "     2970.0     2997.0     3000.0\n"));
  EXPECT_THAT(report, HasSubstr("age of a pose at its CAN frame         500      600.0      600.0"
                                "      600.0      600.0      600.0\n"));
  EXPECT_THAT(report, HasSubstr("heap calls in the loop 3\n"));
}

TEST(Measure, CountsEveryTickInOneLineOfTheHistogram) {
  Measure measure;
  for (const int n : {1, 2, 3, 100}) measure.write(record_of(n));
  const std::string report = measure.report(0);
  EXPECT_THAT(report, HasSubstr("wake-up latency, us\n"
                                "  below         2         1 #########################\n"
                                "  below         4         2 "));
  EXPECT_THAT(report, HasSubstr("  below       128         1 #"));
}

TEST(Measure, OfNothingIsATableAllTheSame) {
  EXPECT_THAT(Measure{}.report(0), HasSubstr("age of a pose at its CAN frame        none"));
}

}  // namespace
}  // namespace dottrack::firmware
