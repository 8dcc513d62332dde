// The rules, held to every source file of the project.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/architecture/rules.h"
#include "tests/unit/architecture/source_files.h"

namespace dottrack::architecture {
namespace {

constexpr std::size_t kMaxLines = 400;
constexpr std::size_t kFewestFiles = 60;  // fewer, and the walk has missed folders
constexpr std::size_t kFewestCoreFiles = 20;

const std::vector<SourceFile>& project() {
  static const std::vector<SourceFile> kFiles = source_files(DOTTRACK_SOURCE_DIR);
  return kFiles;
}

template <class Check>
Violations everywhere(Check check) {
  Violations all;
  for (const SourceFile& file : project()) {
    for (std::string& violation : check(file)) all.push_back(std::move(violation));
  }
  return all;
}

Violations too_long(const SourceFile& file) {
  const std::size_t lines = count_lines(file.text);
  if (lines <= kMaxLines) return {};
  return {file.path + ": " + std::to_string(lines) + " lines, more than " +
          std::to_string(kMaxLines)};
}

// An -inl.h is read once for each SIMD target, by a guard of its own. What C compilers of others
// are to read has the guard of the C standard.
Violations header_without_guard(const SourceFile& file) {
  constexpr std::string_view kForC = "app/core/protocol/receiver/";
  if (file.path.starts_with(kForC) && file.text.find("#ifndef DOTTRACK_") != file.text.npos) {
    return {};
  }
  if (!file.path.ends_with(".h") || file.path.ends_with("-inl.h")) return {};
  if (file.text.starts_with("#pragma once\n")) return {};
  return {file.path + ":1: does not start with #pragma once"};
}

TEST(Architecture, TheWalkFindsTheProject) {
  const auto in_core =
      std::count_if(project().begin(), project().end(),
                    [](const SourceFile& file) { return file.path.starts_with("app/core/"); });
  EXPECT_GE(project().size(), kFewestFiles);
  EXPECT_GE(static_cast<std::size_t>(in_core), kFewestCoreFiles);
}

TEST(Architecture, EveryIncludePointsInAnAllowedDirection) {
  EXPECT_THAT(everywhere(forbidden_includes), testing::IsEmpty());
}

TEST(Architecture, TheCoreKnowsNoClockThreadFileOrHeap) {
  EXPECT_THAT(everywhere(impurities), testing::IsEmpty());
}

TEST(Architecture, NoFileIsOver400Lines) {
  EXPECT_THAT(everywhere(too_long), testing::IsEmpty());
}

TEST(Architecture, EveryHeaderIsIncludedOnce) {
  EXPECT_THAT(everywhere(header_without_guard), testing::IsEmpty());
}

}  // namespace
}  // namespace dottrack::architecture
