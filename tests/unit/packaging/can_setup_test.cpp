// can.txt, as a user writes it, and what becomes of it.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/unit/packaging/shell_run.h"

namespace dottrack::test {
namespace {

class CanSetup : public testing::Test {
 protected:
  // Gives what was said; network() is what was written.
  ShellRun set_up(const std::string& can_txt) {
    folder_.write("can.txt", can_txt);
    return set_up();
  }

  ShellRun set_up() {
    const std::string program =
        DOTTRACK_SOURCE_DIR "/toolchain/image/root/usr/lib/dottrack/can-setup";
    const std::string folder = folder_.path().string();
    return run_shell("sh " + program + " " + folder + "/can.txt " + folder + "/network");
  }

  std::string network() const {
    std::ifstream in(folder_.path() / "network/50-can.network");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  bool has(const std::string& line) const {
    return network().find("\n" + line + "\n") != std::string::npos;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(CanSetup, TakesWhatTheFileSays) {
  const ShellRun run = set_up("bit_rate = 250000\ndata_bit_rate=2000000 # FD\nrestart_ms = 50\n");
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(has("BitRate=250000"));
  EXPECT_TRUE(has("DataBitRate=2000000"));
  EXPECT_TRUE(has("FDMode=yes"));
  EXPECT_TRUE(has("RestartSec=50ms"));
  EXPECT_EQ(run.said, "CAN at 250000 bit/s, data at 2000000 bit/s\n");
}

TEST_F(CanSetup, ReadsFilesOfWindows) {
  set_up("# mine\r\n\r\n  bit_rate\t=  125000\r\nrestart_ms = 20");
  EXPECT_TRUE(has("BitRate=125000"));
  EXPECT_TRUE(has("RestartSec=20ms"));
}

TEST_F(CanSetup, IsClassicUnlessToldOtherwise) {
  set_up("bit_rate = 1000000\n");
  EXPECT_TRUE(has("BitRate=1000000"));
  EXPECT_EQ(network().find("FDMode"), std::string::npos);
  EXPECT_EQ(network().find("DataBitRate"), std::string::npos);
}

TEST_F(CanSetup, WithoutAFileTakesTheUsualRateAndSaysSo) {
  const ShellRun run = set_up();
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(has("BitRate=500000"));
  EXPECT_NE(run.said.find("can.txt: no such file"), std::string::npos) << run.said;
}

struct Spoilt {
  const char* line;
  const char* complaint;
};

class SpoiltCanSetup : public CanSetup, public testing::WithParamInterface<Spoilt> {};

TEST_P(SpoiltCanSetup, NamesTheLineAndKeepsTheUsualRate) {
  const ShellRun run = set_up(std::string("# one\n") + GetParam().line + "\nrestart_ms = 70\n");
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(has("BitRate=500000")) << network();
  EXPECT_TRUE(has("RestartSec=70ms")) << "the lines after it still count";
  EXPECT_EQ(network().find("DataBitRate"), std::string::npos);
  EXPECT_NE(run.said.find("can.txt:2: "), std::string::npos) << run.said;
  EXPECT_NE(run.said.find(GetParam().complaint), std::string::npos) << run.said;
}

INSTANTIATE_TEST_SUITE_P(
    Lines, SpoiltCanSetup,
    testing::Values(Spoilt{"bit_rate = 500k", "expected a whole number from 10000 to 1000000"},
                    Spoilt{"bit_rate =", "expected a whole number from 10000 to 1000000"},
                    Spoilt{"bit_rate = 2000000", "expected a whole number from 10000 to 1000000"},
                    Spoilt{"bit_rate = -1", "expected a whole number from 10000 to 1000000"},
                    Spoilt{"bit_rate = 99999999999999999999", "expected a whole number"},
                    Spoilt{"data_bit_rate = fast", "expected a whole number from 10000 to 8000000"},
                    Spoilt{"bitrate = 250000", "expected bit_rate, data_bit_rate or restart_ms"},
                    Spoilt{"250000", "expected bit_rate, data_bit_rate or restart_ms"},
                    Spoilt{"bit_rate = $(reboot)", "expected a whole number"}));

}  // namespace
}  // namespace dottrack::test
