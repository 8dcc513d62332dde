#pragma once
// Just enough of a DBC reader to read a frame by its rules, knowing nothing of our encoder.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace dottrack::protocol::test {

struct DbcSignal {
  std::string name;
  unsigned start = 0;
  unsigned length = 0;
  bool intel = false;
  bool is_signed = false;
  double factor = 0.0;
  double offset = 0.0;
  double minimum = 0.0;
  double maximum = 0.0;
  std::map<std::int64_t, std::string> values;

  std::int64_t raw(const std::vector<std::uint8_t>& data) const;  // Intel order only
  double physical(const std::vector<std::uint8_t>& data) const;
};

struct DbcMessage {
  std::uint32_t id = 0;
  std::string name;
  unsigned length_bytes = 0;
  std::map<std::string, DbcSignal> signals;
};

// Throws std::runtime_error on a line that starts like a message, a signal or a value table and
// does not read as one.
std::map<std::uint32_t, DbcMessage> read_dbc(const std::filesystem::path& path);

}  // namespace dottrack::protocol::test
