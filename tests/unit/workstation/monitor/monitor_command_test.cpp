#include "app/workstation/monitor_command.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/protocol/light_message.h"
#include "app/workstation/dbc/dbc_file.h"
#include "app/workstation/dbc/dottrack_dbc.h"
#include "app/workstation/dbc_command.h"
#include "app/workstation/unit_command.h"
#include "drivers/candump/candump_can_bus.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/support/program_run.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/workstation/json_check.h"
#include "tests/unit/workstation/monitor/sent_groups.h"

namespace dottrack::workstation {
namespace {

using dottrack::test::ProgramRun;
using dottrack::test::run_program;
using monitor::Arrival;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<double> numbers_of(std::string line, char separator) {
  std::vector<double> numbers;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, separator);) numbers.push_back(std::stod(field));
  return numbers;
}

class MonitorCommand : public testing::Test {
 protected:
  static constexpr unsigned kGroups = 40;

  void write(const std::vector<Arrival>& arrivals) const {
    rtos::VirtualClock clock;
    auto log = drivers::CandumpCanBus::open(log_, clock);
    ASSERT_TRUE(log);
    for (const Arrival& arrival : arrivals) {
      clock.jump_to(Time(arrival.time));
      ASSERT_EQ((*log)->send(arrival.frame, Time{}), hal::SendResult::accepted);
      ASSERT_TRUE((*log)->flush());
    }
  }
  ProgramRun run(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"monitor", "--log", log_.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(add_monitor_command, arguments);
  }

  dottrack::test::TemporaryFolder folder_;
  std::filesystem::path log_ = folder_.path() / "can.log";
};

TEST_F(MonitorCommand, WritesALineAGroupAndTheStatistics) {
  std::vector<Arrival> arrivals = monitor::test::groups(kGroups);
  monitor::test::append(arrivals, monitor::test::identity(kGroups));
  write(arrivals);
  const ProgramRun result = run({"--strict"});
  EXPECT_EQ(result.status, 0);
  const std::vector<std::string> lines = lines_of(result.out);
  ASSERT_GT(lines.size(), kGroups);
  EXPECT_THAT(lines[0], HasSubstr("1700000000.000000 fresh"));
  EXPECT_THAT(lines[0], HasSubstr("tracking  1.0000 -2.5000 0.2500 m"));
  EXPECT_THAT(lines[0], HasSubstr("cameras 1-2,4  dots 5  few_cameras"));
  EXPECT_THAT(result.out, HasSubstr("fresh 40 (with a pose 40), stale 0"));
  EXPECT_THAT(result.out,
              HasSubstr("unit: 1.2.3, protocol 2, configuration 1A2B3C4D, target 2, 8 cameras"));
}

TEST_F(MonitorCommand, WritesJsonAGroupAndForTheWhole) {
  write(monitor::test::groups(kGroups));
  const ProgramRun result = run({"--json"});
  EXPECT_EQ(result.status, 0);
  const std::vector<std::string> lines = lines_of(result.out);
  ASSERT_EQ(lines.size(), kGroups + 1);
  for (const std::string& line : lines) EXPECT_TRUE(is_json(line)) << line;
  EXPECT_EQ(json_member(lines[3], "verdict"), "\"fresh\"");
  EXPECT_EQ(json_member(lines[3], "capture_s"), "40.099000");
  EXPECT_EQ(json_member(lines[3], "cameras_used"), "[1,2,4]");
  EXPECT_EQ(json_member(lines[3], "degraded"), "[\"few_cameras\"]");
  EXPECT_EQ(json_member(lines.back(), "fresh_valid_poses"), "40");
  EXPECT_EQ(json_member(lines.back(), "lost_groups"), "0");
}

TEST_F(MonitorCommand, TellsTheLightOfEveryCamera) {
  std::vector<Arrival> arrivals = monitor::test::groups(kGroups);
  exposure::CameraLight light;
  light.state = exposure::LightState::too_dark;
  light.iris = exposure::IrisCondition::at_end;
  light.setting = {std::chrono::milliseconds(10), 8.0};
  arrivals.push_back({monitor::test::arrival_of(kGroups), protocol::encode_light(2, light, {}, 0)});
  light = {};
  arrivals.push_back({monitor::test::arrival_of(kGroups), protocol::encode_light(4, light, {}, 1)});
  write(arrivals);
  EXPECT_THAT(run({"--strict"}).out,
              HasSubstr("light: too_dark 3, off 5; iris at_end 3, automatic 5\n"));
  const ProgramRun result = run({"--json"});
  const std::string summary = lines_of(result.out).back();
  EXPECT_TRUE(is_json(summary)) << summary;
  EXPECT_THAT(summary, HasSubstr("\"light\":[{\"camera\":3,\"state\":\"too_dark\",\"iris\":"
                                 "\"at_end\",\"exposure_s\":0.01,\"gain\":8,\"opening\":1},"
                                 "{\"camera\":5,\"state\":\"off\",\"iris\":\"automatic\","
                                 "\"exposure_s\":null,\"gain\":null,\"opening\":null}]"));
  EXPECT_THAT(run({"--signals"}).out, HasSubstr("DOTTRACK_Light  CRC"));
}

TEST_F(MonitorCommand, TumAndCsvHaveThePosesThatWereSent) {
  write(monitor::test::groups(kGroups));
  const auto tum = folder_.path() / "poses.tum";
  const auto csv = folder_.path() / "poses.csv";
  ASSERT_EQ(run({"--tum", tum.string(), "--csv", csv.string()}).status, 0);
  const std::vector<std::string> tum_lines = lines_of(text_of(tum));
  const std::vector<std::string> csv_lines = lines_of(text_of(csv));
  ASSERT_EQ(tum_lines.size(), kGroups);
  ASSERT_EQ(csv_lines.size(), kGroups + 1);
  EXPECT_THAT(csv_lines[0], StartsWith("#timestamp [ns],p_x [m]"));
  const auto columns = std::count(csv_lines[0].begin(), csv_lines[0].end(), ',') + 1;
  for (unsigned n = 0; n < kGroups; ++n) {
    const protocol::PoseMessage sent = monitor::test::message_of(n);
    const std::vector<double> t = numbers_of(tum_lines[n], ' ');
    const std::vector<double> c = numbers_of(csv_lines[n + 1], ',');
    ASSERT_EQ(t.size(), 8U);
    ASSERT_EQ(static_cast<long>(c.size()), columns);
    EXPECT_NEAR(t[0], 40.0 + 0.033 * n, 1e-9);
    EXPECT_NEAR(c[0], 1e9 * t[0], 1.0);
    EXPECT_NEAR(t[1], sent.position_m.x(), 0.000051);
    EXPECT_NEAR(c[1], sent.position_m.x(), 0.000051);
    EXPECT_NEAR(t[6], sent.orientation.z(), 0.00005);
    EXPECT_NEAR(c[7], sent.orientation.z(), 0.00005);
    EXPECT_NEAR(c[4], sent.orientation.w(), 0.00005);
    EXPECT_NEAR(c[8], 0.3, 0.0006);
    EXPECT_NEAR(c[13], 0.5, 0.0003);
    EXPECT_GE(c[14], 0.001);
  }
}

TEST_F(MonitorCommand, NamesEverySignalOfEveryFrame) {
  const std::vector<Arrival> sent = monitor::test::frames_of(3);
  write(sent);
  const ProgramRun text = run({"--signals"});
  EXPECT_THAT(text.out, HasSubstr("300  DOTTRACK_Status  CRC "));
  EXPECT_THAT(text.out, HasSubstr("State tracking  PoseValid 1"));
  EXPECT_THAT(text.out, HasSubstr("X 1.03 m  Y -2.5 m"));
  const ProgramRun json = run({"--signals", "--json"});
  std::size_t frames = 0;
  for (const std::string& line : lines_of(json.out)) {
    EXPECT_TRUE(is_json(line)) << line;
    frames += json_member(line, "signals") ? 1U : 0U;
  }
  EXPECT_EQ(frames, sent.size());
}

TEST_F(MonitorCommand, ReadsAnotherBaseWith29Bits) {
  const protocol::Addressing addressing{.base_id = 0x18EF00, .extended = true, .fd = false};
  write(monitor::test::groups(5, addressing));
  EXPECT_EQ(run().status, 1);
  const ProgramRun result = run({"--base-id", "0x18EF00", "--extended", "--signals"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("18EF00  DOTTRACK_Status"));
}

TEST_F(MonitorCommand, WrongUseIsOneLineAndStatusTwo) {
  std::ofstream(log_) << "no frame\nnor here\n";
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"monitor"}, "expected either an interface such as can0 or --log FILE"},
      {{"monitor", "can0", "--log", "x"}, "expected either"},
      {{"monitor", "--log", (folder_.path() / "none").string()}, "cannot be read"},
      {{"monitor", "--log", folder_.path().string()}, "cannot be read"},
      {{"monitor", "--log", log_.string()}, "no line is a CAN frame"},
      {{"monitor", "--log", log_.string(), "--base-id", "0x7FF"}, "leaves no room"},
      {{"monitor", "--log", log_.string(), "--tum", "/none/poses.tum"}, "cannot write"},
      {{"monitor", "--log", log_.string(), "--mavlink", "nonsense"}, "dottrack: "},
      {{"monitor", "nocan7"}, "nocan7"},
  };
  for (const auto& [arguments, expected] : cases) {
    const ProgramRun result = run_program(add_monitor_command, arguments);
    EXPECT_EQ(result.status, 2) << expected;
    EXPECT_THAT(result.err, HasSubstr(expected));
    EXPECT_EQ(lines_of(result.err).size(), 1U);
  }
}

TEST_F(MonitorCommand, AnEmptyLogHasNoPose) {
  write({});
  EXPECT_EQ(run().status, 1);
}

dbc::DbcFile printed_dbc(std::vector<std::string> options) {
  options.insert(options.begin(), "dbc");
  const ProgramRun result = run_program(add_dbc_command, options);
  EXPECT_EQ(result.status, 0);
  Result<dbc::DbcFile> file = dbc::parse_dbc(result.out, "printed");
  EXPECT_TRUE(file) << file.error().message;
  return file ? *file : dbc::DbcFile{};
}

TEST(DbcCommand, ShiftsEveryIdentifier) {
  const Result<dbc::DbcFile> original = dbc::parse_dbc(dbc::dottrack_dbc(), "dottrack.dbc");
  ASSERT_TRUE(original);
  const dbc::DbcFile moved = printed_dbc({"--base-id", "0x18EF00", "--extended"});
  ASSERT_EQ(moved.messages.size(), original->messages.size());
  ASSERT_GT(moved.messages.size(), 50U);
  for (std::size_t i = 0; i < moved.messages.size(); ++i) {
    const dbc::DbcMessage& from = original->messages[i];
    const dbc::DbcMessage& to = moved.messages[i];
    EXPECT_EQ(to.id, from.id - 0x300 + 0x18EF00);
    EXPECT_TRUE(to.extended);
    EXPECT_EQ(to.name, from.name);
    EXPECT_EQ(to.comment, from.comment);
    ASSERT_EQ(to.signals.size(), from.signals.size());
    for (std::size_t s = 0; s < to.signals.size(); ++s) {
      EXPECT_EQ(to.signals[s].values, from.signals[s].values);
      EXPECT_EQ(to.signals[s].comment, from.signals[s].comment);
    }
    EXPECT_EQ(to.attributes.at("E2EDataId"), from.attributes.at("E2EDataId"));
  }
  const dbc::DbcMessage* fd_pose = moved.find("DOTTRACK_FdPose");
  ASSERT_NE(fd_pose, nullptr);
  EXPECT_EQ(fd_pose->attributes.at("VFrameFormat"), "15");
  EXPECT_THAT(moved.comment, HasSubstr("the base 0x18EF00 (29 bits)"));
}

TEST(DbcCommand, WithoutOptionsPrintsTheLayoutAsItIs) {
  const ProgramRun result = run_program(add_dbc_command, {"dbc"});
  EXPECT_EQ(result.out, dbc::dottrack_dbc());
  EXPECT_EQ(run_program(add_dbc_command, {"dbc", "--base-id", "0x7C1"}).status, 2);
}

TEST(UnitCommand, WrongUseIsOneLineAndStatusTwo) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"command", "nocan7", "acquire", "1"}, "with set-target, and with nothing else"},
      {{"command", "nocan7", "set-target"}, "expected the number of a target"},
      {{"command", "nocan7", "acquire"}, "nocan7"},
  };
  for (const auto& [arguments, expected] : cases) {
    const ProgramRun result = run_program(add_unit_command, arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace dottrack::workstation
