#pragma once
// The targets of a rig file: one [target], or several [[target]].

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/config/complaint.h"
#include "app/core/rig.h"

namespace dottrack::config {

// A target as the rig file has it, its dots not yet read.
struct NamedTarget {
  std::string name;
  core::Target target;
  std::filesystem::path dots;  // as the rig file names it
  std::size_t dots_line = 0;
  bool allow_ambiguous = false;  // warn of a target that looks like itself turned, load it still
};

// In the order of the file, with names of their own.
std::vector<NamedTarget> read_targets(Complaint& complaint, const toml::table& root);

}  // namespace dottrack::config
