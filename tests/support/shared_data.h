#pragma once
// Reference data that lies beside the checkout and is not part of it. Tests on it skip when it is
// absent: GTEST_SKIP() << "shared data absent: ...".

#include <filesystem>
#include <optional>
#include <system_error>

namespace dottrack::test {

// <source folder>/../shared/data, or nothing when there is no such folder.
inline std::optional<std::filesystem::path> shared_data() {
  const auto folder =
      (std::filesystem::path(DOTTRACK_SOURCE_DIR) / ".." / "shared" / "data").lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) return std::nullopt;
  return folder;
}

}  // namespace dottrack::test
