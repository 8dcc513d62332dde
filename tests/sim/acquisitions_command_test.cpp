// `dottrack sim --acquisitions` and `dottrack acquisitions` as a user runs them.

#include "app/workstation/acquisitions_command.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "app/workstation/sim_command.h"
#include "app/workstation/trial_summary.h"
#include "tests/sim/sim_command_fixture.h"
#include "tests/support/text_of.h"
#include "tests/unit/workstation/json_check.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::small_scenario;
using testing::HasSubstr;

constexpr std::size_t kLockableField = 9;  // of a line of acquisitions.csv
constexpr std::size_t kOutcomeField = 11;

class Acquisitions : public SmallScenario {};

TEST_F(Acquisitions, AreCountedByWhatCouldBeSeen) {
  const ProgramRun run = run_sim(
      {scenario(), "--out", at("out").string(), "--acquisitions", "4", "--trial-ticks", "5"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("lockable: enough dots truly in two views"));
  EXPECT_THAT(run.out, HasSubstr("right later, within 5 ticks"));
  EXPECT_THAT(run.out, HasSubstr("acquisitions a second"));
  const auto lines = lines_of(at("out/acquisitions.csv"));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_THAT(lines[0], testing::StartsWith(
                            "scene,seed,index,x_m,y_m,yaw_deg,dots,"
                            "dots_in_two_views,dots_well_lit,lockable,ticks_allowed,outcome,"));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_THAT(lines[i], testing::StartsWith("small,1," + std::to_string(i - 1) + ","));
    EXPECT_EQ(split(lines[i], ',').size(), split(lines[0], ',').size()) << lines[i];
    EXPECT_NE(split(lines[i], ',')[kOutcomeField], "wrong") << lines[i];
  }
  EXPECT_GT(lines_of(at("out/calibration.csv")).size(), 10U);
  const std::string report = text_of(at("out/report.json"));
  ASSERT_TRUE(is_json(report)) << report;
  EXPECT_EQ(json_member(report, "scenario"), "\"small\"");
  EXPECT_EQ(json_member(report, "placements"), "4");
  EXPECT_EQ(json_member(report, "ticks_allowed"), "5");
  EXPECT_EQ(json_member(report, "wrong_locks"), "0");
  for (const char* key : {"lockable", "others", "wrong_candidates_expected", "trials_per_s"}) {
    EXPECT_TRUE(json_member(report, key)) << key;
  }
}

TEST_F(Acquisitions, InPiecesAreThoseOfOneRun) {
  const std::string file = scenario();
  const auto lines = [&](const std::string& out, const std::string& first, const std::string& count,
                         const std::string& threads) {
    run_sim({file, "--out", at(out).string(), "--first", first, "--acquisitions", count,
             "--threads", threads});
    auto all = lines_of(at(out) / "acquisitions.csv");
    all.erase(all.begin());
    return all;
  };
  auto pieces = lines("a", "0", "1", "3");
  for (const std::string& line : lines("b", "1", "9", "1")) pieces.push_back(line);
  EXPECT_EQ(pieces.size(), 10U);
  EXPECT_EQ(pieces, lines("all", "0", "10", "2"));
  const auto summed_up = [&](std::vector<std::string> outs) {
    for (std::string& out : outs) out = at(out + "/acquisitions.csv").string();
    outs.insert(outs.begin(), "acquisitions");
    return test::run_program(add_acquisitions_command, outs);
  };
  const ProgramRun joined = summed_up({"a", "b"});
  EXPECT_EQ(joined.status, 0) << joined.err;
  EXPECT_EQ(joined.out, summed_up({"all"}).out);
  EXPECT_THAT(joined.out, HasSubstr("lockable: enough dots truly in two views"));
  const ProgramRun twice = summed_up({"a", "all"});
  EXPECT_EQ(twice.status, 2);
  EXPECT_EQ(twice.err,
            "dottrack: placement 0 of small, seed 1, is there twice; expected each once\n");
}

TEST_F(Acquisitions, SumsWithAWrongLockFailAndWrongTablesAreOneLine) {
  const std::string header = trials_csv_header();
  const auto sum = [&](const std::string& text) {
    const fs::path file = folder_.write("table.csv", text);
    return test::run_program(add_acquisitions_command, {"acquisitions", file.string()});
  };
  EXPECT_EQ(sum(header + "s,1,0,0,0,0,5,5,5,1,3,right,none,0,1,1,1e-9,1e-9,1,5,2\n").status, 0);
  EXPECT_EQ(sum(header + "s,1,0,0,0,0,5,5,5,1,3,wrong,none,0,900,1,1e-9,1e-9,0,5,2\n").status, 1);
  const std::string table = at("table.csv").string();
  const auto expect_wrong_use = [&](const ProgramRun& run, const std::string& line) {
    EXPECT_EQ(run.status, 2) << line;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "dottrack: " + line + "\n");
  };
  expect_wrong_use(sum("tick,t_s\n"), table +
                                          ": line 1: expected the header of an acquisitions.csv, "
                                          "scene,seed,index,x_m,y_m...");
  expect_wrong_use(sum(header + "s,1,0\n"),
                   table +
                       ": line 2 is no line of an acquisitions.csv; expected 21 fields as in "
                       "the header");
  expect_wrong_use(sum(header), "no placement in any file; expected lines of acquisitions.csv");
  expect_wrong_use(
      test::run_program(add_acquisitions_command, {"acquisitions", at("none.csv").string()}),
      at("none.csv").string() + ": cannot be read; expected an acquisitions.csv");
}

// Three dots are held back by nature: what is found must persist and move as a vehicle can.
TEST_F(Acquisitions, AreBelievedSoonerWhenTheVehicleDrivesOn) {
  const std::string file = scenario("[vehicle]\ndots = 3\n");
  const auto right_locks = [&](const std::string& speed) {
    const ProgramRun run = run_sim({file, "--out", at("speed" + speed).string(), "--first", "5",
                                    "--acquisitions", "4", "--trial-ticks", "6", "--speed", speed});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const auto lines = lines_of(at("speed" + speed) / "acquisitions.csv");
    EXPECT_EQ(lines.size(), 5U);
    return std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
      return split(line, ',')[kOutcomeField] == "right";
    });
  };
  EXPECT_LT(right_locks("0"), 4);
  EXPECT_EQ(right_locks("0.5"), 4);
}

TEST_F(Acquisitions, WithoutAVehicleNeverLock) {
  std::string text = small_scenario("[vehicle]\nkind = \"none\"\ndots = 4\n");
  text.erase(text.find("[motion]"), text.find("[vehicle]") - text.find("[motion]"));
  const std::string file = folder_.write("none.toml", text).string();
  const ProgramRun run =
      run_sim({file, "--out", at("out").string(), "--acquisitions", "6", "--trial-ticks", "2"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const auto lines = lines_of(at("out/acquisitions.csv"));
  ASSERT_EQ(lines.size(), 7U);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(split(lines[i], ',')[kLockableField], "0") << lines[i];
    EXPECT_THAT(split(lines[i], ',')[kOutcomeField], testing::AnyOf("none", "held_back"))
        << lines[i];
  }
}

}  // namespace
}  // namespace dottrack::workstation
