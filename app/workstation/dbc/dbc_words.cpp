// Single words of a DBC file, and what to say where another one was expected.

#include <charconv>
#include <cmath>

#include "app/workstation/dbc/dbc_parser.h"

namespace dottrack::dbc {
namespace {

constexpr std::uint32_t kExtendedBit = 0x80000000U;
constexpr std::uint32_t kOrphanId = 0xC0000000U;  // of the message that is none
constexpr std::uint32_t kLastStandardId = 0x7FF;
constexpr std::uint32_t kLastExtendedId = 0x1FFFFFFF;

// Control characters replaced and not too long: a complaint stays on its line.
std::string shown(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  std::string line(text.substr(0, kMostShown));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return line;
}

std::string unescaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape =
        text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '"' || text[i + 1] == '\\');
    if (escape) ++i;
    out.push_back(text[i]);
  }
  return out;
}

template <class Number>
bool to_number(std::string_view digits, Number& number) {
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return error == std::errc() && stop == end;
}

}  // namespace

std::string quoted(std::string_view text) {
  std::string line(1, '"');
  return line.append(text).append(1, '"');
}

bool Parser::wrong(std::size_t line, const std::string& what) {
  if (complaint_.empty()) complaint_ = name_ + ":" + std::to_string(line) + ": " + what;
  return false;
}

bool Parser::unexpected(std::string_view expected) {
  const std::string seen = token_.kind == Token::Kind::end           ? "the file ends"
                           : token_.kind == Token::Kind::broken_text ? "a text without its end"
                           : token_.kind == Token::Kind::text ? "text " + quoted(shown(token_.view))
                                                              : quoted(shown(token_.view));
  return wrong(token_.line, seen + "; expected " + std::string(expected));
}

bool Parser::expect(std::string_view symbol) {
  if (!token_.is(symbol)) return unexpected(quoted(symbol));
  advance();
  return true;
}

bool Parser::read_word(std::string& word, std::string_view what) {
  if (token_.kind != Token::Kind::word) return unexpected(what);
  word = token_.view;
  advance();
  return true;
}

bool Parser::read_text(std::string& text, std::string_view what) {
  if (token_.kind != Token::Kind::text) return unexpected(what);
  text = unescaped(token_.view);
  advance();
  return true;
}

bool Parser::read_unsigned(std::uint64_t& number, std::uint64_t limit, std::string_view what) {
  const bool read = token_.kind == Token::Kind::number && to_number(token_.view, number);
  if (!read || number > limit) return unexpected(what);
  advance();
  return true;
}

bool Parser::read_integer(std::int64_t& number, std::string_view what) {
  const bool read = token_.kind == Token::Kind::number && to_number(token_.view, number);
  if (!read) return unexpected(what);
  advance();
  return true;
}

bool Parser::read_number(double& number, std::string_view what) {
  const bool read = token_.kind == Token::Kind::number && to_number(token_.view, number);
  if (!read || !std::isfinite(number)) return unexpected(what);
  advance();
  return true;
}

bool Parser::read_id(Key& id) {
  constexpr std::string_view kExpected =
      "an identifier of 11 bits, or of 29 bits with bit 31 set, as a decimal number";
  std::uint64_t number = 0;
  const bool read =
      token_.kind == Token::Kind::number && to_number(token_.view, number) && number <= 0xFFFFFFFFU;
  if (!read) return unexpected(kExpected);
  const auto whole = static_cast<std::uint32_t>(number);
  id = {whole & ~kExtendedBit, (whole & kExtendedBit) != 0};
  const std::uint32_t last = id.second ? kLastExtendedId : kLastStandardId;
  if (id.first > last && whole != kOrphanId) return unexpected(kExpected);
  advance();
  return true;
}

bool Parser::read_known_message(DbcMessage*& message) {
  const Token token = token_;
  Key id;
  if (!read_id(id)) return false;
  const auto found = index_.find(id);
  if (found == index_.end()) {
    return wrong(token.line, "message " + shown(token.view) +
                                 " is not declared; expected the identifier of a BO_ above");
  }
  message = &file_.messages[found->second];
  return true;
}

bool Parser::read_known_signal(DbcSignal*& signal) {
  DbcMessage* message = nullptr;
  std::string name;
  if (!read_known_message(message)) return false;
  const std::size_t line = token_.line;
  if (!read_word(name, "a signal's name")) return false;
  for (DbcSignal& candidate : message->signals) {
    if (candidate.name == name) {
      signal = &candidate;
      return true;
    }
  }
  return wrong(line, "message \"" + message->name + "\" has no signal \"" + shown(name) +
                         "\"; expected one of its signals");
}

}  // namespace dottrack::dbc
