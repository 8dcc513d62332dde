// The script that makes dbc_layout.h ends the build at a line it cannot read, and names it.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "app/workstation/dbc/dottrack_dbc.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::protocol::test {
namespace {

struct Outcome {
  int status = -1;
  std::string output;
};

class LayoutScript : public testing::Test {
 protected:
  Outcome make(const std::string& text) const {
    std::ofstream(folder_.path() / "bad.dbc") << text;
    const std::string script = std::string(DOTTRACK_SOURCE_DIR) + "/app/core/protocol/";
    const std::string command = std::string(DOTTRACK_CMAKE) + " -D DBC=" + dbc() +
                                " -D HEADER=" + (folder_.path() / "layout.h").string() + " -P " +
                                script + "dbc_layout.cmake 2>&1";
    Outcome outcome;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return outcome;
    // CMake breaks lines where it likes: one blank for all of white space.
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
      const char next = std::isspace(c) != 0 ? ' ' : static_cast<char>(c);
      if (next != ' ' || !outcome.output.ends_with(' ')) outcome.output += next;
    }
    outcome.status = WEXITSTATUS(pclose(pipe));
    return outcome;
  }

  // One line of dottrack.dbc replaced.
  void expect_refused(const std::string& line, const std::string& by,
                      const std::string& complaint) const {
    std::string text(dbc::dottrack_dbc());
    const std::size_t at = text.find("\n" + line + "\n");
    ASSERT_NE(at, std::string::npos) << line;
    const auto number = 2 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
    text.replace(at + 1, line.size(), by);
    const Outcome outcome = make(text);
    EXPECT_NE(outcome.status, 0) << by;
    EXPECT_NE(outcome.output.find(dbc() + ":" + std::to_string(number) + ": "), std::string::npos)
        << outcome.output;
    EXPECT_NE(outcome.output.find(complaint), std::string::npos) << outcome.output;
  }

  std::string dbc() const { return (folder_.path() / "bad.dbc").string(); }

  dottrack::test::TemporaryFolder folder_;
};

TEST_F(LayoutScript, MakesTheHeaderOfTheDbcAsItIs) {
  const Outcome outcome = make(std::string(dbc::dottrack_dbc()));
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  std::ostringstream header;
  header << std::ifstream(folder_.path() / "layout.h").rdbuf();
  EXPECT_NE(header.str().find("namespace fd_pose {"), std::string::npos);
}

TEST_F(LayoutScript, NamesTheLineItCannotRead) {
  const std::string message = "BO_ 769 DOTTRACK_Time: 8 DOTTRACK";
  expect_refused(message, "BO_ 769 DOTTRACK_Time 8 DOTTRACK", "expected 'BO_ id");
  expect_refused(message, "BO_ 769 DOTTRACK_Time: 9 DOTTRACK", "8 bytes, or 64");
  expect_refused(message, "BO_ 768 DOTTRACK_Time: 8 DOTTRACK", "there");
  expect_refused(message, "BOX_ 769 DOTTRACK_Time: 8 DOTTRACK", "not a line of a DBC");
  const std::string signal =
      " SG_ MidExposure : 16|48@1+ (1,0) [0|281474976710655] \"us\" Receiver";
  for (const char* wrong : {" SG_ MidExposure : 16|48@0+ (1,0) [0|1] \"us\" Receiver",
                            " SG_ MidExposure : 16|48@1+ (1,5) [0|1] \"us\" Receiver",
                            " SG_ MidExposure : 16|48@1* (1,0) [0|1] \"us\" Receiver",
                            " SG_ MidExposure : 16|48@1+ (1,0) [0|1 \"us\" Receiver",
                            " SG_ MidExposure : 16|48@1+ (1.2.3,0) [0|1] \"us\" Receiver",
                            " SG_ Mid Exposure : 16|48@1+ (1,0) [0|1] \"us\" Receiver"}) {
    expect_refused(signal, wrong, "expected ' SG_ Name");
  }
  expect_refused(signal, " SG_ MidExposure : 17|48@1+ (1,0) [0|1] \"us\" Receiver", "1 to 52 bits");
  expect_refused(signal, " SG_ Sequence : 16|48@1+ (1,0) [0|1] \"us\" Receiver", "already");
}

TEST_F(LayoutScript, ReliesOnMarkersAndDataIds) {
  expect_refused("VAL_ 770 Age 65535 \"not available\" ;", "VAL_ 770 Age 65534 \"not available\" ;",
                 "has to be 65535");
  expect_refused("VAL_ 771 X -8388608 \"not available\" ;",
                 "VAL_ 771 X 8388608 \"not available\" ;", "has to be -8388608");
  expect_refused("VAL_ 770 Age 65535 \"not available\" ;", "VAL_ 770 Ages 65535 \"none\" ;",
                 "not there");
  expect_refused("BA_ \"E2EDataId\" BO_ 770 3;", "BA_ \"E2EDataId\" BO_ 770 three;",
                 "expected 'BA_");
  std::string text(dbc::dottrack_dbc());
  const std::string line = "BA_ \"E2EDataId\" BO_ 770 3;\n";
  text.erase(text.find(line), line.size());
  const Outcome outcome = make(text);
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.output.find("770 quality has no attribute E2EDataId"), std::string::npos)
      << outcome.output;
}

}  // namespace
}  // namespace dottrack::protocol::test
