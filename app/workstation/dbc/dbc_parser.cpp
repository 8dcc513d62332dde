#include "app/workstation/dbc/dbc_parser.h"

#include <algorithm>
#include <string>

namespace dottrack::dbc {
namespace {

constexpr std::size_t kMaxSignals = 512;  // as many as 64 bytes have bits
constexpr unsigned kMaxSignalBits = 64;
// A place for signals that belong to no message, which some editors write.
constexpr std::string_view kOrphanage = "VECTOR__INDEPENDENT_SIG_MSG";

// Motorola: the bits go down within a byte and on to the next byte.
unsigned place_from_front(unsigned bit) {
  return bit / 8 * 8 + 7 - bit % 8;
}

bool fits(const DbcSignal& signal, unsigned bytes) {
  const unsigned first = signal.intel ? signal.start : place_from_front(signal.start);
  return first + signal.length <= bytes * 8;
}

}  // namespace

Result<DbcFile> Parser::parse() {
  while (token_.kind != Token::Kind::end) {
    if (!read_statement()) return fail(complaint_);
  }
  std::erase_if(file_.messages, [](const DbcMessage& m) { return m.name == kOrphanage; });
  return std::move(file_);
}

bool Parser::read_statement() {
  if (token_.kind != Token::Kind::word) return unexpected("a section such as BO_ or CM_");
  const std::string_view section = token_.view;
  if (section == "VERSION") return read_version();
  if (section == "NS_" || section == "BS_" || section == "BU_") return skip_lines();
  if (section == "BO_") return read_message();
  if (section == "CM_") return read_comment();
  if (section == "BA_") return read_attribute();
  if (section == "VAL_") return read_values();
  if (section == "SIG_VALTYPE_") return read_value_type();
  if (section == "SG_MUL_VAL_") {
    return wrong(token_.line, "multiplexed signals; expected a file without them");
  }
  if (section == "SG_") return wrong(token_.line, "a signal outside of a message");
  return skip_statement();
}

bool Parser::read_version() {
  advance();
  return read_text(file_.version, "the version");
}

bool Parser::skip_lines() {
  do {
    advance();
    if (token_.kind == Token::Kind::broken_text) return unexpected("a closed text");
  } while (token_.kind != Token::Kind::end && !token_.begins_line);
  return true;
}

bool Parser::skip_statement() {
  while (!token_.is(";")) {
    if (token_.kind == Token::Kind::end || token_.kind == Token::Kind::broken_text) {
      return unexpected("\";\" at the end of the statement");
    }
    advance();
  }
  advance();
  return true;
}

bool Parser::read_message() {
  const std::size_t line = token_.line;
  DbcMessage message;
  Key id;
  std::uint64_t bytes = 0;
  advance();
  const bool read = read_id(id) && read_word(message.name, "a message's name") && expect(":") &&
                    read_unsigned(bytes, kMaxMessageBytes, "a message of at most 64 bytes") &&
                    read_word(message.sender, "the name of who sends the message");
  if (!read) return false;
  message.id = id.first;
  message.extended = id.second;
  message.length_bytes = static_cast<unsigned>(bytes);
  while (token_.is("SG_")) {
    if (!read_signal(message)) return false;
  }
  return add_message(std::move(message), line);
}

bool Parser::add_message(DbcMessage message, std::size_t line) {
  const bool is_new = index_.emplace(Key(message.id, message.extended), index_.size()).second;
  if (!is_new) {
    return wrong(line, "message " + quoted(message.name) +
                           " has the identifier of another one; expected one of its own");
  }
  file_.messages.push_back(std::move(message));
  return true;
}

bool Parser::read_signal(DbcMessage& message) {
  const std::size_t line = token_.line;
  DbcSignal signal;
  advance();
  if (!read_word(signal.name, "a signal's name")) return false;
  if (token_.kind == Token::Kind::word) {
    return wrong(token_.line, "signal " + quoted(signal.name) + " is multiplexed (" +
                                  std::string(token_.view) +
                                  "); expected a file without multiplexed signals");
  }
  const bool read = expect(":") && read_layout(signal) && read_scale(signal) &&
                    read_text(signal.unit, "the unit in quotes") && read_receivers(signal);
  return read && check_place(message, signal, line) && add_signal(message, std::move(signal), line);
}

bool Parser::check_place(const DbcMessage& message, const DbcSignal& signal, std::size_t line) {
  if (message.name == kOrphanage || fits(signal, message.length_bytes)) return true;
  return wrong(line, "signal " + quoted(signal.name) + " does not fit into the " +
                         std::to_string(message.length_bytes) + " bytes of " +
                         quoted(message.name) + "; expected it within them");
}

bool Parser::add_signal(DbcMessage& message, DbcSignal signal, std::size_t line) {
  if (message.signal(signal.name) != nullptr && message.name != kOrphanage) {
    return wrong(line, "message " + quoted(message.name) + " has two signals " +
                           quoted(signal.name) + "; expected different names");
  }
  if (message.signals.size() == kMaxSignals) {
    return wrong(line, "message " + quoted(message.name) + " has over " +
                           std::to_string(kMaxSignals) + " signals; expected fewer");
  }
  message.signals.push_back(std::move(signal));
  return true;
}

// start|length@order sign
bool Parser::read_layout(DbcSignal& signal) {
  std::uint64_t start = 0;
  std::uint64_t length = 0;
  const bool read =
      read_unsigned(start, kMaxMessageBytes * 8 - 1, "a start bit from 0 to 511") && expect("|") &&
      read_unsigned(length, kMaxSignalBits, "a length of 1 to 64 bits") && expect("@");
  if (!read) return false;
  signal.start = static_cast<unsigned>(start);
  signal.length = static_cast<unsigned>(length);
  if (length == 0) return wrong(token_.line, "a signal of 0 bits; expected 1 to 64");
  std::uint64_t order = 0;
  if (!read_unsigned(order, 1, "the byte order, 0 or 1")) return false;
  signal.intel = order == 1;
  signal.is_signed = token_.is("-");
  if (!signal.is_signed && !token_.is("+")) return unexpected("\"+\" (unsigned) or \"-\" (signed)");
  advance();
  return true;
}

// (factor,offset) [minimum|maximum]
bool Parser::read_scale(DbcSignal& signal) {
  const std::size_t line = token_.line;
  const bool read = expect("(") && read_number(signal.factor, "the factor") && expect(",") &&
                    read_number(signal.offset, "the offset") && expect(")") && expect("[") &&
                    read_number(signal.minimum, "the minimum") && expect("|") &&
                    read_number(signal.maximum, "the maximum") && expect("]");
  if (read && signal.factor == 0.0) return wrong(line, "a factor of 0; expected another number");
  return read;
}

bool Parser::read_receivers(DbcSignal& signal) {
  do {
    if (token_.is(",")) advance();
    std::string receiver;
    if (!read_word(receiver, "the name of who receives the signal")) return false;
    signal.receivers.push_back(std::move(receiver));
  } while (token_.is(","));
  return true;
}

}  // namespace dottrack::dbc
