// `dottrack sim` as a user runs it.

#include "app/workstation/sim_command.h"

#include <gmock/gmock.h>

#include <unistd.h>
#include <csignal>

#include <chrono>
#include <thread>

#include "app/workstation/replay_command.h"
#include "tests/sim/sim_command_fixture.h"
#include "tests/support/text_of.h"
#include "tests/unit/workstation/json_check.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::small_scenario;
using testing::HasSubstr;

class SimCommand : public SmallScenario {};

TEST_F(SimCommand, LeavesPosesTruthPlotsPicturesAndAReport) {
  const ProgramRun run = run_sim({scenario(), "--out", at("out").string()});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_TRUE(test::only_warnings(run.err)) << run.err;
  EXPECT_THAT(run.out, HasSubstr("ticks with a pose        6 of 6\n"));
  EXPECT_THAT(run.out, HasSubstr("wrong-lock ticks         0\n"));
  EXPECT_EQ(lines_of(at("out/truth.tum")).size(), 6U);
  EXPECT_EQ(lines_of(at("out/poses.tum")).size(), 6U);
  for (const char* file :
       {"poses.csv", "can.log", "rig/rig.toml", "pictures/cam1.png", "pictures/first_lock/cam4.png",
        "plots/path.svg", "plots/errors.svg", "plots/usage.svg", "plots/cycle_times.svg"}) {
    EXPECT_GT(fs::file_size(at("out") / file), 100U) << file;
  }
  const std::string report = text_of(at("out/report.json"));
  ASSERT_TRUE(is_json(report)) << report;
  for (const char* key : {"position_rms_mm", "position_max_mm", "attitude_rms_deg",
                          "attitude_max_deg", "nees_mean", "ticks_per_s"}) {
    EXPECT_TRUE(json_member(report, key)) << key;
  }
  EXPECT_EQ(json_member(report, "scenario"), "\"small\"");
  EXPECT_EQ(json_member(report, "seed"), "1");
  EXPECT_EQ(json_member(report, "wrong_lock_ticks"), "0");
  EXPECT_EQ(json_member(report, "interrupted"), "false");
  EXPECT_EQ(json_member(report, "allocations_in_loop"), "0");
}

TEST_F(SimCommand, TheSameSeedGivesTheSameBytesAndSoDoesTheReplayOfItsFrames) {
  const std::string file = scenario(
      "[[camera_fault]]\ncamera = \"cam2\"\nkind = \"dead\"\n"
      "from_s = 0.15\nto_s = 0.35\n");
  const auto sim = [&](const std::string& out, const std::string& threads) {
    return run_sim({file, "--out", at(out).string(), "--record", at(out + "_frames").string(),
                    "--threads", threads, "--no-pictures"});
  };
  ASSERT_EQ(sim("a", "1").status, 0);
  ASSERT_EQ(sim("b", "3").status, 0);
  const ProgramRun replay =
      test::run_program(add_replay_command, {"replay", at("a/rig/rig.toml").string(), "--frames",
                                             at("a_frames").string(), "--out", at("c").string()});
  EXPECT_EQ(replay.status, 0) << replay.err;
  for (const char* name : {"poses.tum", "poses.csv", "can.log"}) {
    const std::string live = text_of(at("a") / name);
    EXPECT_GT(live.size(), 300U);
    EXPECT_EQ(text_of(at("b") / name), live) << name;
    EXPECT_EQ(text_of(at("c") / name), live) << name;
  }
  EXPECT_TRUE(fs::exists(at("a_frames/cam2/000001.pgm")));
  EXPECT_FALSE(fs::exists(at("a_frames/cam2/000002.pgm")));
  for (const char* name : {"cam1/000000.pgm", "cam4/000005.pgm", "times.csv"}) {
    EXPECT_EQ(text_of(at("a_frames") / name), text_of(at("b_frames") / name)) << name;
  }
}

TEST_F(SimCommand, AnotherSeedIsAnotherRun) {
  const auto poses = [&](const std::string& seed) {
    const fs::path out = at("seed" + seed);
    run_sim({scenario(), "--out", out.string(), "--seed", seed, "--ticks", "2", "--no-pictures"});
    return text_of(out / "poses.csv");
  };
  EXPECT_NE(poses("1"), poses("2"));
}

TEST_F(SimCommand, WithoutAVehicleNoPoseIsRight) {
  std::string text = small_scenario("[vehicle]\nkind = \"none\"\ndots = 4\n");
  text.erase(text.find("[motion]"), text.find("[vehicle]") - text.find("[motion]"));
  const std::string file = folder_.write("none.toml", text).string();
  const ProgramRun run = run_sim({file, "--out", at("out").string(), "--no-pictures"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("first lock               never\n"));
  EXPECT_EQ(text_of(at("out/truth.tum")), "");
}

TEST_F(SimCommand, ExplainsTicksWithoutAPose) {
  const std::string file = scenario(
      "[[camera_fault]]\ncamera = \"cam2\"\nkind = \"dead\"\nfrom_s = 0.0\nto_s = 9.0\n"
      "[[camera_fault]]\ncamera = \"cam3\"\nkind = \"dead\"\nfrom_s = 0.0\nto_s = 9.0\n"
      "[[camera_fault]]\ncamera = \"cam4\"\nkind = \"dead\"\nfrom_s = 0.0\nto_s = 9.0\n");
  const ProgramRun run = run_sim({file, "--out", at("out").string(), "--no-pictures", "--explain"});
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_THAT(run.out, HasSubstr("tick 0: no pose: too_few_cameras, while acquiring\n"));
  EXPECT_THAT(run.out, HasSubstr("    cam4           no image\n"));
  EXPECT_THAT(run.out, HasSubstr("ticks 1 to 5: too_few_cameras still\n"));
}

TEST_F(SimCommand, WrongInputIsOneLine) {
  const std::string outside = small_scenario();
  const auto moved = [&](const std::string& from, const std::string& to) {
    std::string text = outside;
    text.replace(text.find(from), from.size(), to);
    return folder_.write(to.substr(0, 5) + "wrong.toml", text).string();
  };
  const fs::path taken = folder_.write("taken", "a file");
  const std::string out = at("out").string();
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Case> cases = {
      {{"no_such", "--out", out}, "no_such"},
      {{moved("rocks", "rokcs"), "--out", out}, "rokcswrong.toml:9: "},
      {{moved("[-0.8, -0.5]", "[-8.0, -0.5]"), "--out", out}, "outside the hall"},
      {{moved("ticks = 6", "ticks = 0"), "--out", out}, "wrong.toml:4: "},
      {{scenario(), "--ticks", "0", "--out", out}, "ticks is 0"},
      {{scenario(), "--out", taken.string()}, "taken"},
      {{scenario(), "--record", taken.string(), "--out", out}, "taken"},
  };
  for (const Case& c : cases) {
    const ProgramRun run = run_sim(c.arguments);
    EXPECT_EQ(run.status, 2) << c.says;
    EXPECT_THAT(run.err, HasSubstr(c.says));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

// A camera that looks away from a vehicle that stands still.
TEST_F(SimCommand, ATargetThatNoCameraSeesIsRefused) {
  const std::string file = folder_
                               .write("blind.toml", R"([scenario]
name = "blind"
ticks = 5

[motion]
kind = "stand"
at = [0.0, 0.0]

[[camera]]
name = "a"
at = [5.0, 0.0, 3.0]
aim = [9.0, 0.0, 0.0]

[[camera]]
name = "b"
at = [5.0, 1.0, 3.0]
aim = [9.0, 1.0, 0.0]
)")
                               .string();
  const ProgramRun run = run_sim({file, "--out", at("out").string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("no camera"));
}

// The wish comes while the hall is rendered; the run ends with the ticks it has.
TEST_F(SimCommand, CtrlCEndsARunWithWhatItHas) {
  const std::string file = scenario();
  std::thread user([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(getpid(), SIGINT);
  });
  const ProgramRun run = run_sim({file, "--ticks", "100000", "--out", at("out").string()});
  user.join();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("stopped after "));
  const std::string report = text_of(at("out/report.json"));
  EXPECT_EQ(json_member(report, "interrupted"), "true");
  EXPECT_EQ(json_member(report, "ticks"), std::to_string(lines_of(at("out/truth.tum")).size()));
}

}  // namespace
}  // namespace dottrack::workstation
