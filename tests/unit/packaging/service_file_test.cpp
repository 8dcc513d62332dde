// The service file as systemd judges it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/unit/packaging/shell_run.h"

namespace dottrack::test {
namespace {

const std::string kServiceFile = DOTTRACK_SOURCE_DIR "/toolchain/package/dottrackd.service";

// The sum that `systemd-analyze security` gives: 0 is a program that can do nothing.
TEST(ServiceFile, IsExposedByNoMoreThanThree) {
  const ShellRun run =
      run_shell("systemd-analyze security --offline=true --no-pager " + kServiceFile);
  if (run.status == 127 || run.said.find("unrecognized option") != std::string::npos) {
    GTEST_SKIP() << "no systemd-analyze that judges files";
  }
  const std::string label = "Overall exposure level for dottrackd.service: ";
  const std::size_t at = run.said.find(label);
  ASSERT_NE(at, std::string::npos) << run.said;
  const double exposure = std::strtod(run.said.c_str() + at + label.size(), nullptr);
  EXPECT_GT(exposure, 0.0);
  EXPECT_LE(exposure, 3.0) << run.said;
}

// What the loop asks for at its start must not be taken away by the sandbox.
TEST(ServiceFile, LeavesWhatTheLoopNeeds) {
  const ShellRun run = run_shell("cat " + kServiceFile);
  ASSERT_EQ(run.status, 0);
  for (const char* line :
       {"Type=notify\n", "WatchdogSec=30\n", "Restart=always\n", "LimitRTPRIO=95\n",
        "LimitMEMLOCK=infinity\n", "DeviceAllow=char-video4linux rw\n",
        "DeviceAllow=char-media rw\n", "DeviceAllow=char-gpiochip rw\n",
        "DeviceAllow=char-watchdog rw\n", "RestrictAddressFamilies=AF_CAN AF_NETLINK AF_UNIX\n",
        "ConditionPathExists=/etc/dottrack/rig.toml\n"}) {
    EXPECT_NE(run.said.find(std::string("\n") + line), std::string::npos) << line;
  }
  EXPECT_EQ(run.said.find("RestrictRealtime=yes"), std::string::npos);
  EXPECT_EQ(run.said.find("PrivateDevices=yes"), std::string::npos);
}

}  // namespace
}  // namespace dottrack::test
