#pragma once
// The words of a DBC file, one by one.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dottrack::dbc {

struct Token {
  enum class Kind : std::uint8_t { end, word, number, text, symbol, broken_text };
  Kind kind = Kind::end;
  std::string_view view;  // of a text what is between the quotes, as written
  std::size_t line = 1;
  bool begins_line = false;  // nothing before it on its line, not even a blank

  bool is(std::string_view what) const {
    return (kind == Kind::word || kind == Kind::symbol) && view == what;
  }
};

// Numbers have their sign; whatever is none of word, number and text is a symbol of one character.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  Token next();

 private:
  void skip_blanks();
  std::size_t word_end() const;
  std::size_t number_end() const;
  Token quoted(Token token);
  Token take(Token token, Token::Kind kind, std::size_t end);

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

}  // namespace dottrack::dbc
