#include "app/workstation/dbc/dbc_file.h"

#include <gmock/gmock.h>

#include <array>
#include <string>

#include "app/workstation/dbc/dottrack_dbc.h"

namespace dottrack::dbc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Every kind of line that other programs write, in one file.
constexpr std::string_view kPlenty = R"(VERSION "1.0 \"beta\""


NS_ :
	CM_
	BA_DEF_
	SIG_VALTYPE_

BS_: 500000

BU_: UNIT
	READER
VAL_TABLE_ onoff 1 "on" 0 "off" ;

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ Nowhere : 0|8@1+ (1,0) [0|0] "" Vector__XXX

BO_ 100 Small: 3 UNIT
 SG_ Low : 4|12@1- (0.5,10) [-1014|1033.5] "m/s" READER
 SG_ High : 7|10@0+ (1e-3,0) [0|1.023] "%" READER,UNIT

BO_ 2364540158 Extended : 8 UNIT
 SG_ All:0|64@1+(1,0)[0|0]"" READER

CM_ "A network; with a \"quote\" and
a second line";
CM_ BU_ UNIT "who sends";
CM_ BO_ 100 "A message.";
CM_ SG_ 100 Low "A signal.";
BA_DEF_ BO_ "CycleTime" INT 0 1000;
BA_DEF_DEF_ "CycleTime" 0;
BA_ "Bus" "CAN";
BA_ "CycleTime" BO_ 100 33;
BA_ "Start" SG_ 100 Low 7;
VAL_ 100 Low -3 "minus three" 2047 "not available" ;
SIG_VALTYPE_ 100 Low : 0;
)";

DbcFile parsed(std::string_view text) {
  Result<DbcFile> file = parse_dbc(text, "test.dbc");
  EXPECT_TRUE(file) << file.error().message;
  return file ? std::move(*file) : DbcFile{};
}

std::string complaint(std::string_view text) {
  const Result<DbcFile> file = parse_dbc(text, "test.dbc");
  return file ? "none" : file.error().message;
}

TEST(DbcFile, HasMessagesAndSignalsWithAllThatIsSaidOfThem) {
  const DbcFile file = parsed(kPlenty);
  EXPECT_EQ(file.version, "1.0 \"beta\"");
  EXPECT_EQ(file.comment, "A network; with a \"quote\" and\na second line");
  EXPECT_EQ(file.attributes.at("Bus"), "CAN");
  ASSERT_EQ(file.messages.size(), 2U);
  const DbcMessage& small = file.messages[0];
  EXPECT_EQ(small.id, 100U);
  EXPECT_FALSE(small.extended);
  EXPECT_EQ(small.length_bytes, 3U);
  EXPECT_EQ(small.sender, "UNIT");
  EXPECT_EQ(small.comment, "A message.");
  EXPECT_EQ(small.attributes.at("CycleTime"), "33");
  EXPECT_EQ(small.attributes.size(), 1U);
  ASSERT_EQ(small.signals.size(), 2U);
  const DbcSignal& low = small.signals[0];
  EXPECT_EQ(low.start, 4U);
  EXPECT_EQ(low.length, 12U);
  EXPECT_TRUE(low.intel);
  EXPECT_TRUE(low.is_signed);
  EXPECT_EQ(low.factor, 0.5);
  EXPECT_EQ(low.offset, 10.0);
  EXPECT_EQ(low.minimum, -1014.0);
  EXPECT_EQ(low.maximum, 1033.5);
  EXPECT_EQ(low.unit, "m/s");
  EXPECT_EQ(low.comment, "A signal.");
  EXPECT_EQ(low.values.at(-3), "minus three");
  EXPECT_FALSE(small.signals[1].intel);
  EXPECT_THAT(small.signals[1].receivers, ElementsAre("READER", "UNIT"));
  EXPECT_TRUE(file.messages[1].extended);
  EXPECT_EQ(file.messages[1].id, 2364540158U & 0x7FFFFFFFU);
  EXPECT_NE(file.find(100, false), nullptr);
  EXPECT_EQ(file.find(100, true), nullptr);
  EXPECT_EQ(file.find("Extended"), &file.messages[1]);
}

TEST(DbcDecode, ReadsIntelAndMotorolaOrder) {
  const DbcFile file = parsed(kPlenty);
  // Low: the upper half of byte 0 and byte 1. High: byte 0 from its top, then two bits of byte 1.
  const std::array<std::uint8_t, 3> payload{0xD5, 0xFF, 0x00};
  const auto decoded = decode(file.messages[0], payload);
  ASSERT_EQ(decoded.size(), 2U);
  EXPECT_EQ(decoded[0].raw, -3);
  EXPECT_EQ(decoded[0].physical, 8.5);
  EXPECT_EQ(decoded[0].text, "minus three");
  EXPECT_EQ(decoded[1].raw, 0xD5 * 4 + 3);
  EXPECT_DOUBLE_EQ(decoded[1].physical, 0.855);
  EXPECT_EQ(decoded[1].text, "");
}

TEST(DbcDecode, ReadsSixtyFourBitsAndLeavesOutWhatIsNotThere) {
  const DbcFile file = parsed(kPlenty);
  hal::CanFrame frame{.id = file.messages[1].id, .extended = true, .length = 8, .data = {}};
  frame.data.fill(0xFF);
  auto decoded = decode(file, frame);
  ASSERT_TRUE(decoded && decoded->size() == 1);
  EXPECT_EQ(decoded->front().physical, 18446744073709551615.0);
  frame.length = 7;
  decoded = decode(file, frame);
  EXPECT_TRUE(decoded && decoded->empty());
  frame.length = 255;
  EXPECT_TRUE(decode(file, frame));
  frame.extended = false;
  EXPECT_FALSE(decode(file, frame));
}

TEST(DbcFile, AMalformedTextIsOneLineThatSaysWhere) {
  const std::string head = "BO_ 100 M: 8 U\n";
  const std::pair<std::string, std::string> cases[] = {
      {"BO_", "test.dbc:1: the file ends; expected an identifier"},
      {"BO_ 4096 M: 8 U", "\"4096\"; expected an identifier"},
      {"BO_ 99999999999 M: 8 U", "expected an identifier"},
      {"BO_ 100 M: 65 U", "\"65\"; expected a message of at most 64 bytes"},
      {head + head, "test.dbc:2: message \"M\" has the identifier of another one"},
      {head + " SG_ S m0 : 0|8@1+ (1,0) [0|1] \"\" U", "multiplexed (m0)"},
      {head + " SG_ S M : 0|8@1+ (1,0) [0|1] \"\" U", "multiplexed (M)"},
      {head + " SG_ S : 0|65@1+ (1,0) [0|1] \"\" U", "a length of 1 to 64 bits"},
      {head + " SG_ S : 0|0@1+ (1,0) [0|1] \"\" U", "a signal of 0 bits"},
      {head + " SG_ S : 60|5@1+ (1,0) [0|1] \"\" U", "does not fit into the 8 bytes of \"M\""},
      {head + " SG_ S : 56|2@0+ (1,0) [0|1] \"\" U", "does not fit"},
      {head + " SG_ S : 0|8@2+ (1,0) [0|1] \"\" U", "the byte order, 0 or 1"},
      {head + " SG_ S : 0|8@1 (1,0) [0|1] \"\" U", "\"+\" (unsigned) or \"-\" (signed)"},
      {head + " SG_ S : 0|8@1+ (nan,0) [0|1] \"\" U", "\"nan\"; expected the factor"},
      {head + " SG_ S : 0|8@1+ (1e999,0) [0|1] \"\" U", "expected the factor"},
      {head + " SG_ S : 0|8@1+ (0,0) [0|1] \"\" U", "a factor of 0"},
      {head + " SG_ S : 0|8@1+ (1,0) [0|1] \"m U", "test.dbc:2: a text without its end"},
      {" SG_ S : 0|8@1+ (1,0) [0|1] \"\" U", "a signal outside of a message"},
      {"CM_ BO_ 100 \"\";", "message 100 is not declared"},
      {head + "CM_ SG_ 100 S \"\";", "has no signal \"S\""},
      {head + "CM_ BO_ 100 \"text\"", "the file ends; expected \";\""},
      {head + "VAL_ 100", "expected a signal's name"},
      {head + "BA_ \"A\" BO_ 100 ;", "\";\"; expected the attribute's value"},
      {"EV_ never ends", "expected \";\" at the end of the statement"},
      {"SG_MUL_VAL_ 100 S T 0-0;", "multiplexed"},
      {"\x01\x02", "\"?\"; expected a section"},
  };
  for (const auto& [text, expected] : cases) EXPECT_THAT(complaint(text), HasSubstr(expected));
  const std::string floating =
      head + " SG_ S : 0|32@1- (1,0) [0|1] \"\" U\nSIG_VALTYPE_ 100 S : 1;";
  EXPECT_THAT(complaint(floating), HasSubstr("signal \"S\" is a floating-point number"));
  EXPECT_THAT(complaint(std::string(kMaxTextBytes + 1, ' ')), HasSubstr("larger than 4 MiB"));
}

TEST(DbcFile, EveryBeginningOfAFileIsReadOrRefused) {
  std::size_t refused = 0;
  for (std::size_t size = 0; size < kPlenty.size(); ++size) {
    const Result<DbcFile> file = parse_dbc(kPlenty.substr(0, size), "test.dbc");
    if (file) continue;
    ++refused;
    EXPECT_THAT(file.error().message, HasSubstr("; expected "));
    EXPECT_EQ(file.error().message.find('\n'), std::string::npos);
  }
  EXPECT_GT(refused, kPlenty.size() / 2);
}

TEST(DottrackDbc, IsPartOfTheProgramAndWellFormed) {
  const DbcFile file = parsed(dottrack_dbc());
  EXPECT_EQ(file.version, "2");
  EXPECT_EQ(file.messages.size(), 52U);
  std::size_t signals = 0;
  for (const DbcMessage& message : file.messages) {
    EXPECT_EQ(message.attributes.count("E2EDataId"), 1U) << message.name;
    EXPECT_NE(message.comment, "") << message.name;
    EXPECT_NE(message.signal("Sequence"), nullptr) << message.name;
    signals += message.signals.size();
  }
  EXPECT_GT(signals, 250U);
  const DbcMessage* position = file.find(0x303, false);
  ASSERT_NE(position, nullptr);
  EXPECT_EQ(position->name, "DOTTRACK_Position");
  EXPECT_EQ(position->signal("X")->values.at(-8388608), "not available");
}

}  // namespace
}  // namespace dottrack::dbc
