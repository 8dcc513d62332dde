// What a DBC file says about messages that it has declared before: comments, attributes, names of
// values.

#include "app/workstation/dbc/dbc_parser.h"

namespace dottrack::dbc {

bool Parser::read_comment() {
  advance();
  if (token_.kind == Token::Kind::text) {
    return read_text(file_.comment, "the comment") && expect(";");
  }
  if (token_.is("BO_")) {
    DbcMessage* message = nullptr;
    advance();
    return read_known_message(message) && read_text(message->comment, "the comment") && expect(";");
  }
  if (token_.is("SG_")) {
    DbcSignal* signal = nullptr;
    advance();
    return read_known_signal(signal) && read_text(signal->comment, "the comment") && expect(";");
  }
  if (!token_.is("BU_") && !token_.is("EV_")) return unexpected("a text, BO_, SG_, BU_ or EV_");
  return skip_statement();
}

// BA_ "name" [BO_ id | SG_ id signal | BU_ node | EV_ variable] value;
bool Parser::read_attribute() {
  std::string name;
  advance();
  if (!read_text(name, "the attribute's name in quotes")) return false;
  std::map<std::string, std::string>* owner = &file_.attributes;
  if (token_.is("BO_")) {
    DbcMessage* message = nullptr;
    advance();
    if (!read_known_message(message)) return false;
    owner = &message->attributes;
  } else if (token_.kind == Token::Kind::word) {
    return skip_statement();
  }
  std::string value;
  if (token_.kind == Token::Kind::number) {
    value = token_.view;
    advance();
  } else if (!read_text(value, "the attribute's value, a number or a text")) {
    return false;
  }
  owner->insert_or_assign(std::move(name), std::move(value));
  return expect(";");
}

// VAL_ id signal raw "name" raw "name" ... ;
bool Parser::read_values() {
  advance();
  if (token_.kind == Token::Kind::word) return skip_statement();  // of an environment variable
  DbcSignal* signal = nullptr;
  return read_known_signal(signal) && read_value_list(*signal);
}

bool Parser::read_value_list(DbcSignal& signal) {
  while (!token_.is(";")) {
    std::int64_t raw = 0;
    std::string text;
    if (!read_integer(raw, "a whole number or \";\"")) return false;
    if (!read_text(text, "in quotes what the value is called")) return false;
    signal.values.insert_or_assign(raw, std::move(text));
  }
  advance();
  return true;
}

// SIG_VALTYPE_ id signal : type; 0 is a whole number, 1 and 2 are floating-point.
bool Parser::read_value_type() {
  const std::size_t line = token_.line;
  DbcSignal* signal = nullptr;
  std::uint64_t type = 0;
  advance();
  if (!read_known_signal(signal)) return false;
  if (token_.is(":")) advance();
  if (!read_unsigned(type, 3, "a type from 0 to 3") || !expect(";")) return false;
  if (type == 0) return true;
  return wrong(
      line, "signal \"" + signal->name + "\" is a floating-point number; expected none of those");
}

}  // namespace dottrack::dbc
