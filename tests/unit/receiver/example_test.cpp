// The example for vehicles as its user meets it where there is no CAN: one line and status 2.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace dottrack::receiver_test {
namespace {

using testing::StartsWith;

struct Outcome {
  int status = -1;
  std::string err;
};

Outcome print_poses(const std::string& arguments) {
  const std::string command = std::string("'") + DOTTRACK_EXAMPLE + "' " + arguments + " 2>&1";
  Outcome outcome;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 256> text{};
  while (std::fgets(text.data(), static_cast<int>(text.size()), pipe) != nullptr) {
    outcome.err += text.data();
  }
  const int status = ::pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

void expect_refusal(const std::string& arguments, const std::string& start) {
  const Outcome outcome = print_poses(arguments);
  EXPECT_EQ(outcome.status, 2) << arguments;
  EXPECT_THAT(outcome.err, StartsWith(start)) << arguments;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << arguments;
}

TEST(ReceiverExample, AnswersWrongUseWithOneLine) {
  for (const char* arguments : {"", "can0 can1", "-q can0", "-b", "-b twelve can0", "-b 0x7C1 can0",
                                "-x -b 0x1FFFFFC1 can0", "-n -1 can0"}) {
    expect_refusal(arguments, "usage: print_poses ");
  }
}

TEST(ReceiverExample, SaysWhyItCannotListen) {
  expect_refusal("no-such-bus", "print_poses: no-such-bus: no ");
  expect_refusal("-x -b 0x1FFFFFC0 no-such-bus", "print_poses: no-such-bus: no ");
}

}  // namespace
}  // namespace dottrack::receiver_test
