#pragma once
// One mistake in an otherwise good file, and what the reader should say of it.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"

namespace dottrack::config {

struct Mistake {
  std::string name;
  std::string from;  // in the good text
  std::string to;
  std::string message;
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

inline std::string name_of(const testing::TestParamInfo<Mistake>& made) {
  return made.param.name;
}

// The message about a folder's rig file, without the folder's name.
inline std::string complaint_about(const test::RigFolder& folder) {
  const Result<RigConfig> config = load_rig(folder.rig());
  if (config) return "accepted";
  const std::string prefix = folder.path().string() + "/";
  std::string message = config.error().message;
  for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) {
    message.erase(at, prefix.size());
  }
  return message;
}

}  // namespace dottrack::config
