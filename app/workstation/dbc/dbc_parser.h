#pragma once
// From the words of a DBC file to its messages.

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/workstation/dbc/dbc_file.h"
#include "app/workstation/dbc/dbc_lexer.h"

namespace dottrack::dbc {

// Between quotes, for complaints.
std::string quoted(std::string_view text);

// Each read_ function stands at a statement's first word and leaves the cursor behind the
// statement. False: something is wrong, and the first complaint says what; nothing is read after.
class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : lexer_(text), name_(name) { advance(); }

  Result<DbcFile> parse();

 private:
  using Key = std::pair<std::uint32_t, bool>;

  bool read_statement();
  bool read_version();
  bool skip_lines();      // a section of lines: up to a line that begins without a blank
  bool skip_statement();  // up to its semicolon
  bool read_message();
  bool read_signal(DbcMessage& message);
  bool read_layout(DbcSignal& signal);
  bool read_scale(DbcSignal& signal);
  bool read_receivers(DbcSignal& signal);
  bool read_comment();
  bool read_attribute();
  bool read_values();
  bool read_value_list(DbcSignal& signal);
  bool read_value_type();
  bool add_message(DbcMessage message, std::size_t line);
  bool add_signal(DbcMessage& message, DbcSignal signal, std::size_t line);
  bool check_place(const DbcMessage& message, const DbcSignal& signal, std::size_t line);

  bool expect(std::string_view symbol);
  bool read_word(std::string& word, std::string_view what);
  bool read_text(std::string& text, std::string_view what);
  bool read_unsigned(std::uint64_t& number, std::uint64_t limit, std::string_view what);
  bool read_integer(std::int64_t& number, std::string_view what);
  bool read_number(double& number, std::string_view what);
  bool read_id(Key& id);
  bool read_known_message(DbcMessage*& message);
  bool read_known_signal(DbcSignal*& signal);

  void advance() { token_ = lexer_.next(); }
  bool wrong(std::size_t line, const std::string& what);
  bool unexpected(std::string_view expected);  // of the token at hand

  Lexer lexer_;
  Token token_;
  const std::string& name_;
  DbcFile file_;
  std::map<Key, std::size_t> index_;
  std::string complaint_;
};

}  // namespace dottrack::dbc
