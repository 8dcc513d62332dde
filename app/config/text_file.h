#pragma once
// A small text file, whole.

#include <cstddef>
#include <filesystem>
#include <string>

#include "hal/base/result.h"

namespace dottrack::config {

inline constexpr std::size_t kMaxTextBytes = 1U << 20U;  // a configuration is never this large

// The bytes of the file. The error says what is wrong without naming the file: "no such file",
// "is a folder", "cannot be read", "is larger than 1 MiB".
Result<std::string> read_text_file(const std::filesystem::path& path);

}  // namespace dottrack::config
