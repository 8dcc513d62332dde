#include "tests/sim/moved_ticks.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace dottrack::test {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

std::vector<int> moved_ticks(const std::filesystem::path& out, std::size_t cameras) {
  std::ifstream in(out / "poses.csv");
  std::string line;
  std::getline(in, line);
  const auto header = fields_of(line);
  std::vector<int> first(cameras, -1);
  for (int tick = 0; std::getline(in, line); ++tick) {
    const auto fields = fields_of(line);
    for (std::size_t i = 0; i < cameras; ++i) {
      const auto column =
          std::find(header.begin(), header.end(), "cam" + std::to_string(i + 1) + "_moved") -
          header.begin();
      if (fields.at(static_cast<std::size_t>(column)) == "1" && first[i] < 0) first[i] = tick;
    }
  }
  return first;
}

}  // namespace dottrack::test
