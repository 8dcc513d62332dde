#include "app/workstation/dbc/dbc_lexer.h"

namespace dottrack::dbc {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

}  // namespace

void Lexer::skip_blanks() {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') ++line_;
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') return;
  }
}

std::size_t Lexer::word_end() const {
  std::size_t end = at_;
  while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
  return end;
}

// As far as it could be one: whether it is one, the reader of the number says.
std::size_t Lexer::number_end() const {
  std::size_t end = at_ + 1;
  for (; end < text_.size(); ++end) {
    const char c = text_[end];
    const char before = text_[end - 1];
    const bool sign_of_exponent = (c == '+' || c == '-') && (before == 'e' || before == 'E');
    if (!is_digit(c) && !is_letter(c) && c != '.' && !sign_of_exponent) break;
  }
  return end;
}

Token Lexer::take(Token token, Token::Kind kind, std::size_t end) {
  token.kind = kind;
  token.view = text_.substr(at_, end - at_);
  at_ = end;
  return token;
}

Token Lexer::quoted(Token token) {
  std::size_t end = at_ + 1;
  for (; end < text_.size() && text_[end] != '"'; ++end) {
    const bool escaped = text_[end] == '\\' && end + 1 < text_.size() &&
                         (text_[end + 1] == '"' || text_[end + 1] == '\\');
    if (escaped) ++end;
    if (text_[end] == '\n') ++line_;
  }
  const bool closed = end < text_.size();
  token.kind = closed ? Token::Kind::text : Token::Kind::broken_text;
  token.view = text_.substr(at_ + 1, end - at_ - 1);
  at_ = closed ? end + 1 : end;
  return token;
}

Token Lexer::next() {
  skip_blanks();
  Token token;
  token.line = line_;
  if (at_ >= text_.size()) return token;
  token.begins_line = at_ == 0 || text_[at_ - 1] == '\n';
  const char c = text_[at_];
  if (c == '"') return quoted(token);
  if (is_letter(c)) return take(token, Token::Kind::word, word_end());
  const bool sign = c == '+' || c == '-';
  const bool number = is_digit(c) || (sign && at_ + 1 < text_.size() &&
                                      (is_digit(text_[at_ + 1]) || text_[at_ + 1] == '.'));
  if (number) return take(token, Token::Kind::number, number_end());
  return take(token, Token::Kind::symbol, at_ + 1);
}

}  // namespace dottrack::dbc
