// The rules themselves: each catches the made-up file that breaks it and leaves a good one alone.

#include "tests/unit/architecture/rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dottrack::architecture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(IncludeRules, CatchTheCoreThatKnowsTheCycle) {
  const SourceFile file{"app/core/made_up.cpp",
                        "#include <array>\n\n#include \"app/cycle/tick.h\"\n"};
  EXPECT_THAT(forbidden_includes(file),
              ElementsAre("app/core/made_up.cpp:3: app/core may not include app/cycle/tick.h"));
}

TEST(IncludeRules, CatchTheSimulatorThatBorrowsTheCameraModels) {
  const SourceFile file{"host_sim/renderer/made_up.cpp",
                        "#include \"app/core/geometry/cahvor.h\"\n"
                        "#include \"app/core/protocol/pose_message.h\"\n"};
  EXPECT_THAT(forbidden_includes(file),
              ElementsAre("host_sim/renderer/made_up.cpp:1: host_sim may not include "
                          "app/core/geometry/cahvor.h"));
}

TEST(IncludeRules, CatchEachForbiddenDirection) {
  const std::vector<SourceFile> bad{
      {"hal/base/x.h", "#include \"hal/can_bus.h\"\n"},
      {"hal/x.h", "#include \"app/core/rig.h\"\n"},
      {"rtos_shim/clock.h", "#include \"rtos_shim/posix_rt/clock.h\"\n"},
      {"drivers/recorded/x.cpp", "#include \"app/core/rig.h\"\n"},
      {"drivers/recorded/x.cpp", "#include \"drivers/candump/can_log.h\"\n"},
      {"app/core/geometry/x.h", "#include \"app/core/rig.h\"\n"},
      {"app/core/x.cpp", "#include \"hal/frame_grabber.h\"\n"},
      {"app/core/x.cpp", "#include <fmt/format.h>\n"},
      {"app/core/x.cpp", "#include <unistd.h>\n"},
      {"app/config/x.cpp", "#include \"app/cycle/tick.h\"\n"},
      {"app/cycle/x.cpp", "#include \"rtos_shim/virtual_time/clock.h\"\n"},
      {"app/cycle/x.cpp", "#include \"drivers/candump/can_log.h\"\n"},
      {"app/telemetry/x.cpp", "#include \"app/cycle/tick.h\"\n"},
      {"host_sim/x.cpp", "#include \"app/core/tracker.h\"\n"},
      {"host_sim/x.cpp", "#include \"app/config/rig_file.h\"\n"},
      {"app/firmware/x.cpp", "#include \"host_sim/world/scene.h\"\n"},
      {"app/firmware/x.cpp", "#include \"tests/support/shared_data.h\"\n"},
      {"app/core/x.cpp", "#include \"rig.h\"\n"},
      {"app/new_room/x.cpp", "int x;\n"},
      {"#include/x.cpp", ""},
  };
  for (const SourceFile& file : bad) {
    EXPECT_THAT(forbidden_includes(file), SizeIs(1)) << file.path << ": " << file.text;
  }
}

TEST(IncludeRules, LeaveAllowedDirectionsAlone) {
  const std::vector<SourceFile> good{
      {"app/core/tracker.cpp",
       "#include <Eigen/Core>\n#include <array>\n#include \"app/core/image/identify.h\"\n"
       "#include \"hal/base/time.h\"\n// #include \"app/cycle/tick.h\"\n"},
      {"app/core/image/x.cpp", "#include <hwy/highway.h>\n"},
      {"app/cycle/x.cpp", "#include \"rtos_shim/clock.h\"\n#include \"hal/can_bus.h\"\n"},
      {"rtos_shim/posix_rt/x.cpp", "#include <pthread.h>\n#include \"rtos_shim/clock.h\"\n"},
      {"app/workstation/x.cpp",
       "#include \"rtos_shim/virtual_time/clock.h\"\n#include \"host_sim/world/scene.h\"\n"},
      {"tests/unit/x.cpp", "#include \"app/workstation/replay.h\"\n#include <gtest/gtest.h>\n"},
  };
  for (const SourceFile& file : good) EXPECT_THAT(forbidden_includes(file), IsEmpty());
}

TEST(CoreRules, CatchEachImpurity) {
  const std::vector<std::string> bad{
      "auto t = std::chrono::steady_clock::now();",
      "auto t = Clock::now();",
      "std::thread worker;",
      "std::mutex lock;",
      "std::ofstream out;",
      "std::cout << 1;",
      "std::printf(\"%d\", 1);",
      "int* p = new int;",
      "delete p;",
      "void* p = malloc(3);",
      "std::vector<int> v;",
      "std::string s;",
      "Eigen::MatrixXd m;",
      "throw 1;",
      "#include <iostream>",
  };
  for (const std::string& text : bad) {
    EXPECT_FALSE(impurities({"app/core/image/made_up.cpp", text}).empty()) << text;
    EXPECT_THAT(impurities({"app/workstation/made_up.cpp", text}), IsEmpty()) << text;
  }
}

TEST(CoreRules, NameTheLine) {
  EXPECT_THAT(impurities({"app/core/x.cpp", "// new\nint a;\nint* p = new int;\n"}),
              ElementsAre("app/core/x.cpp:3: the core uses the heap: new"));
}

TEST(CoreRules, LeaveCommentsLiteralsAndLikeNamesAlone) {
  EXPECT_THAT(
      impurities({"app/core/x.cpp",
                  "// a new std::thread\n/* malloc( */\nconst char* s = \"new std::mutex\";\n"
                  "Foo(const Foo&) = delete;\nint new_regions = 1'000;\n"
                  "std::string_view name; char c = '\"'; auto m = std::make_unique<M>();\n"}),
      IsEmpty());
}

TEST(SourceFiles, CountLines) {
  EXPECT_EQ(count_lines(""), 0U);
  EXPECT_EQ(count_lines("a"), 1U);
  EXPECT_EQ(count_lines("a\n"), 1U);
  EXPECT_EQ(count_lines("a\nb"), 2U);
}

TEST(SourceFiles, CodeKeepsItsLines) {
  EXPECT_EQ(code_only("a // b\n\"c\\\"d\" e\n"), "a     \n       e\n");
  EXPECT_EQ(code_only("R\"(x\ny)\" z"), "    \n    z");
}

}  // namespace
}  // namespace dottrack::architecture
