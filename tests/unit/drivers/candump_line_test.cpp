#include "drivers/candump/candump_line.h"

#include <gmock/gmock.h>

#include <fstream>

#include "drivers/candump/candump_can_bus.h"
#include "rtos_shim/virtual_time/virtual_clock.h"
#include "tests/support/temporary_folder.h"

namespace dottrack::drivers {
namespace {

using testing::ElementsAre;

TEST(CandumpLine, GivesTimeInterfaceIdentifierAndBytes) {
  const auto logged = parse_candump_line("(1700000000.123456) can1 301#01A2ff");
  ASSERT_TRUE(logged);
  EXPECT_EQ(logged->time, std::chrono::microseconds(1700000000123456));
  EXPECT_EQ(logged->interface, "can1");
  EXPECT_EQ(logged->frame.id, 0x301U);
  EXPECT_FALSE(logged->frame.extended || logged->frame.fd);
  EXPECT_THAT(logged->frame.payload(), ElementsAre(0x01, 0xA2, 0xFF));
}

TEST(CandumpLine, MayHaveNoBytesADirectionAndAnotherLineEnd) {
  for (const char* line : {"(1.000000) can1 7FF#", "(1.000000) can1 7FF# R\r\n",
                           "(1.000000000) can1 7FF#", " (1.000000)  can1  7FF   [0] "}) {
    const auto logged = parse_candump_line(line);
    ASSERT_TRUE(logged) << line;
    EXPECT_EQ(logged->frame.length, 0);
    EXPECT_EQ(logged->time, std::chrono::seconds(1));
  }
  const auto raw_dlc = parse_candump_line("(1.0) can1 7FF#0102030405060708_F");
  ASSERT_TRUE(raw_dlc);
  EXPECT_EQ(raw_dlc->frame.length, 8);
}

TEST(CandumpLine, KnowsExtendedAndFdFrames) {
  const auto extended = parse_candump_line("(1.0) can1 1ABCDEF0#01");
  ASSERT_TRUE(extended);
  EXPECT_TRUE(extended->frame.extended);
  EXPECT_EQ(extended->frame.id, 0x1ABCDEF0U);
  const auto fd = parse_candump_line("(1.0) can1 310##5" + std::string(128, 'a'));
  ASSERT_TRUE(fd);
  EXPECT_TRUE(fd->frame.fd && fd->frame.bit_rate_switch);
  EXPECT_EQ(fd->frame.length, 64);
  EXPECT_EQ(fd->frame.data[63], 0xAA);
}

TEST(CandumpLine, ReadsWhatTheScreenShows) {
  const auto classic = parse_candump_line("(0000000002.500000)  can0  301   [3]  01 A2 FF   '...'");
  ASSERT_TRUE(classic);
  EXPECT_EQ(classic->time, std::chrono::milliseconds(2500));
  EXPECT_THAT(classic->frame.payload(), ElementsAre(0x01, 0xA2, 0xFF));
  EXPECT_FALSE(classic->frame.fd);
  const auto fd = parse_candump_line(" (1.0)  can0  RX B -  00000310  [02]  01 02");
  ASSERT_TRUE(fd);
  EXPECT_TRUE(fd->frame.fd && fd->frame.extended && fd->frame.bit_rate_switch);
  EXPECT_THAT(fd->frame.payload(), ElementsAre(1, 2));
}

TEST(CandumpLine, TellsRemoteRequestsAndErrorsFromData) {
  for (const char* line :
       {"(1.0) can1 301#R", "(1.0) can1 301#R8", "(1.0) can1 00000301#R",
        "(1.0) can1 20000004#0004000000000000", "(1.0)  can1  301   [8]  remote request",
        "(1.0)  can1  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME"}) {
    EXPECT_TRUE(is_remote_or_error_line(line)) << line;
    EXPECT_FALSE(parse_candump_line(line)) << line;
  }
  EXPECT_FALSE(is_remote_or_error_line("(1.0) can1 301#00"));
}

TEST(CandumpLine, EverythingElseIsNoFrame) {
  for (const char* line : {"",
                           "301#0102",
                           "(1.0) can1",
                           "(1.0) can1 301#012",
                           "(1.0) can1 30G#00",
                           "() can1 301#00",
                           "(1) can1 301#00",
                           "(1.) can1 301#00",
                           "(1.0000000001) can1 301#00",
                           "(-1.0) can1 301#00",
                           "(1.-1) can1 301#00",
                           "(1.0 can1 301#00",
                           "(1.0) can1 800#00",
                           "(1.0) can1 0301#00",
                           "(1.0) can1 40000000#00",
                           "(1.0) can1 301##",
                           "(1.0) can1 301##G00",
                           "(1.0) can1 301#0 1",
                           "(1.0) can1 301#000102030405060708",
                           "(1.0) can1 301 [8] 00 11",
                           "(1.0) can1 301 [1] -1",
                           "(1.0) can1 301 [] 00",
                           "(1.0) can1 301 [9] 00",
                           "(1.0) can1 RX"}) {
    EXPECT_FALSE(parse_candump_line(line)) << line;
    EXPECT_FALSE(is_remote_or_error_line(line)) << line;
  }
  EXPECT_FALSE(parse_candump_line("(1.0) can1 310##0" + std::string(130, '0')));
}

hal::CanFrame numbered_frame(unsigned number) {
  hal::CanFrame frame;
  frame.extended = number % 2 == 1;
  frame.fd = number % 4 >= 2;
  frame.bit_rate_switch = number % 8 >= 6;
  frame.id = frame.extended ? 0x1FFFFFFF - number : 0x7FF - number;
  frame.length = static_cast<std::uint8_t>(frame.fd ? 64 : number % 9);
  for (unsigned i = 0; i < frame.length; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(31 * number + i);
  }
  return frame;
}

TEST(CandumpLine, ReadsBackEveryKindOfFrameThatTheWriterWrites) {
  const test::TemporaryFolder folder;
  rtos::VirtualClock clock;
  clock.jump_to(Time(std::chrono::microseconds(9876543210)));
  auto bus = CandumpCanBus::open(folder.path() / "can.log", clock, "averylongname01");
  ASSERT_TRUE(bus);
  constexpr unsigned kFrames = 200;
  for (unsigned i = 0; i < kFrames; ++i) {
    ASSERT_EQ((*bus)->send(numbered_frame(i), Time{}), hal::SendResult::accepted);
  }
  ASSERT_TRUE((*bus)->flush());
  std::ifstream log(folder.path() / "can.log");
  unsigned read = 0;
  for (std::string line; std::getline(log, line); ++read) {
    const auto logged = parse_candump_line(line);
    ASSERT_TRUE(logged) << line;
    EXPECT_EQ(logged->time, std::chrono::microseconds(9876543210));
    EXPECT_EQ(logged->interface, "averylongname01");
    const hal::CanFrame sent = numbered_frame(read);
    EXPECT_EQ(logged->frame.id, sent.id);
    EXPECT_EQ(logged->frame.extended, sent.extended);
    EXPECT_EQ(logged->frame.fd, sent.fd);
    EXPECT_EQ(logged->frame.bit_rate_switch, sent.bit_rate_switch);
    EXPECT_EQ(logged->frame.length, sent.length);
    EXPECT_EQ(logged->frame.data, sent.data);
  }
  EXPECT_EQ(read, kFrames);
}

}  // namespace
}  // namespace dottrack::drivers
