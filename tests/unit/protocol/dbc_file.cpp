#include "tests/unit/protocol/dbc_file.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace dottrack::protocol::test {
namespace {

using Messages = std::map<std::uint32_t, DbcMessage>;

void require(bool read, const std::string& line) {
  if (!read) throw std::runtime_error("DBC line: " + line);
}

DbcMessage parse_message(const std::string& line) {
  DbcMessage message;
  char name[64];
  const int parts = std::sscanf(line.c_str(), "BO_ %u %63[A-Za-z0-9_]: %u ", &message.id, name,
                                &message.length_bytes);
  require(parts == 3, line);
  message.name = name;
  return message;
}

DbcSignal parse_signal(const std::string& line) {
  DbcSignal signal;
  char name[64];
  char order = 0;
  char sign = 0;
  const int parts = std::sscanf(line.c_str(), " SG_ %63s : %u|%u@%c%c (%lf,%lf) [%lf|%lf] \"", name,
                                &signal.start, &signal.length, &order, &sign, &signal.factor,
                                &signal.offset, &signal.minimum, &signal.maximum);
  require(parts == 9 && (order == '0' || order == '1') && (sign == '+' || sign == '-'), line);
  signal.name = name;
  signal.intel = order == '1';
  signal.is_signed = sign == '-';
  return signal;
}

void parse_values(const std::string& line, Messages& messages) {
  unsigned id = 0;
  char name[64];
  int at = 0;
  require(std::sscanf(line.c_str(), "VAL_ %u %63s%n", &id, name, &at) == 2, line);
  DbcSignal& signal = messages.at(id).signals.at(name);
  const char* rest = line.c_str() + at;
  long long value = 0;
  char text[64];
  while (std::sscanf(rest, " %lld \"%63[^\"]\"%n", &value, text, &at) == 2) {
    signal.values[value] = text;
    rest += at;
  }
  require(!signal.values.empty() && std::string(rest) == " ;", line);
}

}  // namespace

std::int64_t DbcSignal::raw(const std::vector<std::uint8_t>& data) const {
  std::int64_t value = 0;
  for (unsigned i = 0; i < length; ++i) {
    const unsigned bit = start + i;
    const bool set = ((data.at(bit / 8) >> (bit % 8)) & 1) != 0;
    if (!set) continue;
    const std::int64_t weight = std::int64_t{1} << i;
    value += is_signed && i == length - 1 ? -weight : weight;
  }
  return value;
}

double DbcSignal::physical(const std::vector<std::uint8_t>& data) const {
  return static_cast<double>(raw(data)) * factor + offset;
}

Messages read_dbc(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  Messages messages;
  DbcMessage* current = nullptr;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("BO_ ")) {
      const DbcMessage message = parse_message(line);
      require(!messages.contains(message.id), line);
      current = &messages.emplace(message.id, message).first->second;
    } else if (line.starts_with(" SG_ ")) {
      const DbcSignal signal = parse_signal(line);
      require(current != nullptr && current->signals.emplace(signal.name, signal).second, line);
    } else if (line.starts_with("VAL_ ")) {
      parse_values(line, messages);
    }
  }
  return messages;
}

}  // namespace dottrack::protocol::test
