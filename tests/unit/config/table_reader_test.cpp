// What a table can be asked for; the rig file's tests hold the rest.

#include "app/config/table_reader.h"

#include <gtest/gtest.h>

#include <functional>

namespace dottrack::config {
namespace {

constexpr NumberRule kMetres{-10.0, 10.0, "metres", true};

class Tables : public testing::Test {
 protected:
  // Reads a table of these lines, which begin on line 1; returns the complaint, or "".
  std::string complaint_of(const std::string& text, const std::function<void(TableReader&)>& read) {
    const toml::table table = toml::parse(text);
    Complaint complaint("f.toml");
    TableReader reader(complaint, table, "the file", {"a", "b"});
    read(reader);
    return complaint.empty() ? "" : complaint.first().message;
  }
};

TEST_F(Tables, GiveListsOfNumbers) {
  EXPECT_EQ(complaint_of("a = [1, -2.5]",
                         [](TableReader& reader) {
                           EXPECT_EQ(reader.numbers("a", 2, std::nullopt, kMetres),
                                     (std::vector<double>{1.0, -2.5}));
                           EXPECT_EQ(reader.numbers("b", 1, {{7.0}}, kMetres),
                                     (std::vector<double>{7.0}));
                         }),
            "");
  const auto read = [](TableReader& reader) { reader.numbers("a", 2, std::nullopt, kMetres); };
  EXPECT_EQ(complaint_of("b = 1", read), "f.toml:1: the file has no key \"a\"; expected metres");
  EXPECT_EQ(complaint_of("a = [1]", read), "f.toml:1: a has a list of 1; expected metres");
  EXPECT_EQ(complaint_of("a = [1, 11]", read), "f.toml:1: a has 11; expected metres");
  EXPECT_EQ(complaint_of("a = [1, inf]", read), "f.toml:1: a has inf; expected metres");
  EXPECT_EQ(complaint_of("a = 3", read), "f.toml:1: a has a whole number; expected metres");
}

TEST_F(Tables, GiveRowsWithTheirLines) {
  EXPECT_EQ(complaint_of("a = [[1, 2],\n[3, 4]]",
                         [](TableReader& reader) {
                           const auto rows = reader.number_rows("a", 2, 1, kMetres);
                           ASSERT_EQ(rows.size(), 2U);
                           EXPECT_EQ(rows[1].values, (std::vector<double>{3.0, 4.0}));
                           EXPECT_EQ(rows[1].line, 2U);
                           EXPECT_TRUE(reader.number_rows("b", 2, 0, kMetres).empty());
                         }),
            "");
  const auto read = [](TableReader& reader) { reader.number_rows("a", 2, 2, kMetres); };
  EXPECT_EQ(complaint_of("a = [[1, 2]]", read), "f.toml:1: a is a list of 1; expected metres");
  EXPECT_EQ(complaint_of("a = [[1, 2],\n[3, \"x\"]]", read),
            "f.toml:2: a has a text; expected metres");
  EXPECT_EQ(complaint_of("a = \"x\"", read), "f.toml:1: a is a text; expected metres");
  EXPECT_EQ(complaint_of("b = 1", read), "f.toml:1: the file has no key \"a\"; expected metres");
}

TEST_F(Tables, GiveChoicesByTheirPlace) {
  const auto read = [](TableReader& reader) { reader.choice("a", {"red", "green"}); };
  EXPECT_EQ(complaint_of("a = \"green\"",
                         [](TableReader& reader) {
                           EXPECT_EQ(reader.choice("a", {"red", "green"}), 1U);
                           EXPECT_EQ(reader.choice("b", {"red", "green"}), 0U);
                         }),
            "");
  EXPECT_EQ(complaint_of("a = \"blue\"", read),
            "f.toml:1: a is \"blue\"; expected one of red, green");
  EXPECT_EQ(complaint_of("a = 1", read),
            "f.toml:1: a is a whole number; expected one of red, green");
}

TEST_F(Tables, GiveTheirTables) {
  EXPECT_EQ(complaint_of("[a]\nx = 1\n[[b]]\n[[b]]\n",
                         [](TableReader& reader) {
                           EXPECT_NE(reader.table("a"), nullptr);
                           EXPECT_EQ(reader.tables("b").size(), 2U);
                         }),
            "");
  EXPECT_EQ(complaint_of("a = 1", [](TableReader& reader) { reader.table("a"); }),
            "f.toml:1: a is a whole number; expected a table [a]");
  EXPECT_EQ(complaint_of("[a]", [](TableReader& reader) { reader.tables("a"); }),
            "f.toml:1: a is a table; expected tables [[a]]");
}

TEST_F(Tables, GiveWholeNumbersBeyondThirtyTwoBits) {
  constexpr IntegerRule kAny{0, std::numeric_limits<std::int64_t>::max(), "a seed"};
  EXPECT_EQ(complaint_of("a = 9000000000",
                         [&](TableReader& reader) {
                           EXPECT_EQ(reader.whole_number("a", 1, kAny), 9'000'000'000);
                           EXPECT_EQ(reader.whole_number("b", 1, kAny), 1);
                         }),
            "");
}

}  // namespace
}  // namespace dottrack::config
