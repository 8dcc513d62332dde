#pragma once
// The project's own source files, as text.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dottrack::architecture {

struct SourceFile {
  std::string path;  // from the root of the project, with slashes
  std::string text;
};

// Every .h and .cpp file of the project's folders, sorted by path.
std::vector<SourceFile> source_files(const std::filesystem::path& root);

struct Include {
  std::size_t line = 0;  // from 1
  std::string path;
  bool angled = false;  // <...> rather than "..."
};

std::vector<Include> includes_of(std::string_view text);

// The text with comments and the insides of literals blanked; lines stay where they are.
std::string code_only(std::string_view text);

std::size_t count_lines(std::string_view text);

}  // namespace dottrack::architecture
