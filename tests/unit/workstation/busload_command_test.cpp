// What dottrack busload prints, and that the table of the documentation is what it prints.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "app/workstation/busload_command.h"

namespace dottrack::workstation {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(BusloadCommand, PrintsALineForEachKindOfMessage) {
  EXPECT_EQ(load_text({.can = {}, .dots = 8, .frame_rate_hz = 25.0}),
            "A group each 40.0 ms.\n"
            "messages                         frames groups       ms      %\n"
            "Status to Orientation                 6      1    1.620   4.05\n"
            "SigmaPosition to Correlation3         5      1    1.350   3.38\n"
            "Velocity, Rates                       2      1    0.540   1.35\n"
            "Cameras                               1     10    0.270   0.07\n"
            "Dot1Position to Dot8Detail           16     10    4.320   1.08\n"
            "Version, Configuration                2     30    0.540   0.04\n"
            "CAN: 10.0 % of 500 kbit/s, fullest group 32 frames in 8.7 ms\n");
}

TEST(BusloadCommand, LeavesOutWhatNeverGoesOut) {
  config::CanUse use{.can = {}, .dots = 8, .frame_rate_hz = 25.0};
  use.can.addressing.fd = true;
  use.can.rates.dots_every = 0;
  const std::string text = load_text(use);
  EXPECT_THAT(text,
              HasSubstr("\nFdPose                                1      1    0.410   1.02\n"));
  EXPECT_THAT(text, Not(HasSubstr("Sigma")));
  EXPECT_THAT(text, Not(HasSubstr("Dot")));
}

TEST(BusloadCommand, TheTableIsThatOfTheDocumentation) {
  std::ostringstream manual;
  manual << std::ifstream(DOTTRACK_SOURCE_DIR "/docs/can.md").rdbuf();
  EXPECT_THAT(manual.str(), HasSubstr(load_table()));
}

}  // namespace
}  // namespace dottrack::workstation
