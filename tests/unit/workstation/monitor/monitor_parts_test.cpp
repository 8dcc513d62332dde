// Sources, words and the exchange of a command, each by itself.

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <numbers>
#include <optional>
#include <sstream>

#include "app/core/protocol/command.h"
#include "app/workstation/monitor/command_exchange.h"
#include "app/workstation/monitor/live_source.h"
#include "app/workstation/monitor/live_table.h"
#include "app/workstation/monitor/log_source.h"
#include "app/workstation/monitor/pose_words.h"
#include "rtos_shim/posix_rt/monotonic_clock.h"
#include "tests/unit/workstation/monitor/sent_groups.h"

namespace dottrack::monitor {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

// A bus whose frames and states a test makes up; a unit may answer what is sent.
class MadeUpBus final : public hal::CanBus {
 public:
  std::deque<hal::CanFrame> incoming;
  hal::CanState current = hal::CanState::active;
  std::optional<protocol::CommandReader> unit;
  rtos::MonotonicClock clock;
  int sent = 0;

 private:
  hal::SendResult do_send(const hal::CanFrame& frame, Time) override {
    if (current != hal::CanState::active) return hal::SendResult::failed;
    ++sent;
    if (!unit) return hal::SendResult::accepted;
    if (const auto verdict = unit->take(frame, clock.now())) {
      if (verdict->result == protocol::CommandResult::done) unit->carried_out(true);
      incoming.push_back(unit->reply(*verdict, verdict->result));
      for (const Arrival& arrival : test::identity(0)) incoming.push_back(arrival.frame);
    }
    return hal::SendResult::accepted;
  }
  bool do_receive(hal::CanFrame& frame) override {
    if (incoming.empty()) return false;
    frame = incoming.front();
    incoming.pop_front();
    return true;
  }
  hal::CanState do_state() const override { return current; }
};

TEST(LogSourceTest, TakesTheFramesOfOneInterfaceInTheOrderOfTime) {
  std::istringstream log(
      "(10.000000) can1 301#01\n\n(11.000000) can0 302#02\nnonsense\n"
      "(9.000000) can1 303#R\n(9.000000) can1 304#04\n");
  LogSource source(log, "");
  Arrival arrival;
  ASSERT_EQ(source.next(arrival), FrameSource::Got::frame);
  EXPECT_EQ(arrival.frame.id, 0x301U);
  ASSERT_EQ(source.next(arrival), FrameSource::Got::frame);
  EXPECT_EQ(arrival.frame.id, 0x304U);
  EXPECT_EQ(arrival.time, std::chrono::seconds(10));
  EXPECT_EQ(source.next(arrival), FrameSource::Got::end);
  EXPECT_EQ(source.unreadable_lines(), 1U);
  EXPECT_EQ(source.frames(), 3U);
}

TEST(LogSourceTest, TakesTheInterfaceThatIsAskedFor) {
  std::istringstream log("(10.000000) can1 301#01\n(11.000000) can0 302#02\n");
  LogSource source(log, "can0");
  Arrival arrival;
  ASSERT_EQ(source.next(arrival), FrameSource::Got::frame);
  EXPECT_EQ(arrival.frame.id, 0x302U);
}

TEST(LiveSourceTest, TellsWhenTheDeviceGoesAndComesBack) {
  MadeUpBus bus;
  const rtos::MonotonicClock clock;
  LiveSource source(bus, clock, "can7", std::chrono::seconds(1700000000));
  bus.incoming.push_back(test::frames_of(0).front().frame);
  Arrival arrival;
  ASSERT_EQ(source.next(arrival), FrameSource::Got::frame);
  EXPECT_GE(arrival.time, std::chrono::seconds(1700000000));
  const Duration before = arrival.time;
  ASSERT_EQ(source.next(arrival), FrameSource::Got::nothing);
  EXPECT_GE(arrival.time, before);
  EXPECT_EQ(source.notice(), "");
  bus.current = hal::CanState::absent;
  EXPECT_EQ(source.notice(), "can7 is down or gone; waiting for it to come back");
  EXPECT_EQ(source.notice(), "");
  bus.current = hal::CanState::bus_off;
  EXPECT_THAT(source.notice(), HasSubstr("off the bus"));
  bus.current = hal::CanState::passive;
  EXPECT_EQ(source.notice(), "can7 is back on the bus");
  bus.current = hal::CanState::active;
  EXPECT_EQ(source.notice(), "");
}

TEST(PoseWords, AnglesAreThoseOfTheVehicle) {
  int compared = 0;
  for (double yaw = -170.0; yaw <= 170.0; yaw += 20.0) {
    for (double pitch = -80.0; pitch <= 80.0; pitch += 20.0) {
      for (double roll = -170.0; roll <= 170.0; roll += 20.0) {
        const double degree = std::numbers::pi / 180.0;
        const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw * degree, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(pitch * degree, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(roll * degree, Eigen::Vector3d::UnitX());
        const double wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
        const RollPitchYaw angles = roll_pitch_yaw(wxyz);
        ASSERT_NEAR(angles.roll_deg, roll, 1e-9);
        ASSERT_NEAR(angles.pitch_deg, pitch, 1e-9);
        ASSERT_NEAR(angles.yaw_deg, yaw, 1e-9);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 2000);
  const double up[4] = {std::numbers::sqrt2 / 2.0, 0.0, -std::numbers::sqrt2 / 2.0, 0.0};
  EXPECT_EQ(roll_pitch_yaw(up).pitch_deg, -90.0);
  EXPECT_EQ(roll_pitch_yaw(up).roll_deg, 0.0);
}

TEST(PoseWords, CamerasAndReasonsAreShort) {
  EXPECT_EQ(camera_numbers(0), "-");
  EXPECT_EQ(camera_numbers(0b1000000001001111), "1-4,7,16");
  EXPECT_EQ(camera_numbers(0xFFFF), "1-16");
  EXPECT_EQ(degraded_words(0), "-");
  EXPECT_EQ(degraded_words(0b1000000000001), "camera_missing few_cameras");
  dottrack_pose pose{};
  pose.camera_health[0] = pose.camera_health[1] = 1;
  pose.camera_health[4] = 3;
  EXPECT_EQ(health_words(pose), "used 1-2, no_frame 5");
}

TEST(PoseWords, HealthNamesACameraThatHasMoved) {
  dottrack_pose pose{};
  pose.camera_health[2] = 7;
  EXPECT_EQ(health_words(pose), "moved 3");
}

dottrack_light light_of(std::uint8_t state, std::uint8_t iris) {
  dottrack_light light{};
  light.known = true;
  light.state = state;
  light.iris = iris;
  return light;
}

TEST(PoseWords, LightNamesEveryCameraThatWasTold) {
  std::array<dottrack_light, DOTTRACK_MAX_CAMERAS> lights{};
  EXPECT_EQ(light_words(lights), "");
  lights[0] = lights[1] = lights[3] = light_of(3, 1);
  lights[6] = light_of(4, 2);
  lights[15] = light_of(6, 3);
  EXPECT_EQ(light_words(lights),
            "steady 1-2,4, too_dark 7, iris_fault 16; iris ok 1-2,4, at_end 7, fault 16");
}

TEST(LiveTableTest, HasEveryFactWithinANarrowTerminal) {
  dottrack_receiver receiver;
  dottrack_receiver_init(&receiver, nullptr);
  Statistics statistics;
  receiver.light[4] = light_of(5, 2);
  const Overview overview{statistics, receiver.counts, receiver.unit, 0, receiver.light};
  TableContent content;
  content.title = "dottrack monitor can0";
  content.verdict = "fresh";
  content.has_pose = true;
  content.pose.valid = content.pose.has_covariance = content.pose.has_cameras = true;
  content.pose.state = DOTTRACK_TRACKING;
  content.pose.orientation_wxyz[0] = 1.0;
  content.pose.position_m[0] = -838.8607;
  content.pose.degraded = 0xFFFF;
  for (std::uint8_t i = 0; i < 16; ++i) content.pose.camera_health[i] = i % 7;
  content.cameras = content.pose;
  std::string all;
  for (const std::string& line : table_lines(content, overview, std::chrono::seconds(1))) {
    EXPECT_THAT(line, SizeIs(testing::Le(79U)));
    all += line + "\n";
  }
  for (const char* word :
       {"tracking", "-838.8607", "camera_missing", "no_frame", "sigma", "too_bright 5",
        "iris at_end 5", "velocity", "attitude", "jitter", "lost", "corrupted", "unit"}) {
    EXPECT_THAT(all, HasSubstr(word));
  }
}

// What a table shows last, drawn into a file instead of a terminal.
std::string last_drawn(const std::vector<Report>& reports) {
  dottrack_receiver receiver;
  dottrack_receiver_init(&receiver, nullptr);
  const Statistics statistics;
  const Overview overview{statistics, receiver.counts, receiver.unit, 0};
  std::FILE* const file = std::tmpfile();
  LiveTable table(file, "title");
  for (const Report& report : reports) table.report(report, overview);
  EXPECT_TRUE(table.finish(overview));
  std::string text(static_cast<std::size_t>(std::ftell(file)), ' ');
  std::rewind(file);
  EXPECT_EQ(std::fread(text.data(), 1, text.size(), file), text.size());
  std::fclose(file);
  return text.substr(text.rfind("title"));
}

TEST(LiveTableTest, AnOldPoseIsNotShownAsNew) {
  dottrack_pose pose{};
  pose.valid = true;
  pose.orientation_wxyz[0] = 1.0;
  pose.position_m[1] = 12.3456;
  Report fresh;
  fresh.pose = &pose;
  Report silence;
  silence.verdict = DOTTRACK_STALE;
  silence.time = std::chrono::milliseconds(1);
  EXPECT_THAT(last_drawn({fresh}), HasSubstr("12.3456"));
  const std::string silent = last_drawn({fresh, silence});
  EXPECT_THAT(silent, HasSubstr("stale: no fresh group within the age limit"));
  EXPECT_THAT(silent, testing::Not(HasSubstr("12.3456")));
}

TEST(CommandExchange, GivesTheReplyAndWhatTheUnitTellsOfItself) {
  MadeUpBus bus;
  bus.unit.emplace(protocol::Addressing{}, std::uint8_t{2});
  CommandRequest request;
  request.token = 77;
  request.sequence = 5;
  const auto answer = exchange(bus, bus.clock, dottrack_default_settings(), request);
  ASSERT_TRUE(answer && answer->reply);
  EXPECT_EQ(answer->reply->result, 0);
  EXPECT_EQ(answer->reply->token, 77);
  EXPECT_EQ(answer->reply->accepted, 1);
  EXPECT_TRUE(answer->unit.has_version && answer->unit.has_configuration);
  EXPECT_EQ(unit_words(answer->unit),
            "1.2.3, protocol 2, configuration 1A2B3C4D, target 2, 8 cameras");
}

TEST(CommandExchange, ASequenceThatTheUnitKnowsIsNotTheEnd) {
  MadeUpBus bus;
  bus.unit.emplace(protocol::Addressing{}, std::uint8_t{2});
  CommandRequest request;
  request.command = DOTTRACK_COMMAND_SET_TARGET;
  request.argument = 9;
  request.sequence = 5;
  const auto first = exchange(bus, bus.clock, dottrack_default_settings(), request);
  ASSERT_TRUE(first && first->reply);
  EXPECT_EQ(first->reply->result, static_cast<int>(protocol::CommandResult::bad_argument));
  const auto second = exchange(bus, bus.clock, dottrack_default_settings(), request);
  ASSERT_TRUE(second && second->reply);
  EXPECT_EQ(second->reply->result, static_cast<int>(protocol::CommandResult::bad_argument));
  EXPECT_EQ(bus.sent, 3);
}

TEST(CommandExchange, NoReplyAndNoBusAreTold) {
  MadeUpBus bus;
  CommandRequest request;
  request.patience = std::chrono::milliseconds(20);
  const auto silent = exchange(bus, bus.clock, dottrack_default_settings(), request);
  ASSERT_TRUE(silent);
  EXPECT_FALSE(silent->reply);
  bus.current = hal::CanState::absent;
  EXPECT_FALSE(exchange(bus, bus.clock, dottrack_default_settings(), request));
}

}  // namespace
}  // namespace dottrack::monitor
