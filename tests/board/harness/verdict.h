#pragma once
// What a run showed, line by line, and whether all of it held.

#include <cstddef>
#include <string>
#include <vector>

namespace dottrack::board {

struct Finding {
  std::string what;
  bool holds = false;
  std::string figures;
};

class Verdict {
 public:
  void add(Finding finding);

  bool all_hold() const;
  const std::vector<Finding>& findings() const { return findings_; }

  std::string json() const;

 private:
  std::vector<Finding> findings_;
};

// `boot to first pose on CAN      ok      38.2 s`
std::string table_line(const Finding& finding);

}  // namespace dottrack::board
