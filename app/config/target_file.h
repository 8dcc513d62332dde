#pragma once
// target.csv -> the dots of a target.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/core/rig.h"
#include "hal/base/result.h"

namespace dottrack::config {

using TargetDots = StaticVector<core::TargetDot, core::kMaxDots>;

struct TargetFile {
  TargetDots dots;
  std::vector<std::string> names;  // of the dots, each once
  std::vector<std::size_t> lines;  // where each dot stands
};

// A header `dot,x_m,y_m,z_m,diameter_m` or the same with `,nx,ny,nz`, then one line a dot, 3 to 16
// of them, in vehicle coordinates. Blank lines, lines that start with # and CRLF are fine. Three
// empty normal fields mean that the normal is not known. Start-up only; an error is one line that
// names file, line and what was expected.
Result<TargetFile> read_target_file(const std::filesystem::path& path);

// The same from text; `name` stands for the file in messages.
Result<TargetFile> parse_target_text(const std::string& text, const std::string& name);

}  // namespace dottrack::config
