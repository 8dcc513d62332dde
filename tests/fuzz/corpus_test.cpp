// Feeds a fuzz target every file of its corpus: what was found once stays found.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::size_t kFewestFiles = 12;

std::vector<std::filesystem::path> corpus() {
  const auto folder =
      std::filesystem::path(DOTTRACK_SOURCE_DIR) / "tests/fuzz/corpus" / DOTTRACK_CORPUS;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Corpus, EveryFileRunsThrough) {
  const auto files = corpus();
  ASSERT_GE(files.size(), kFewestFiles);
  for (const auto& file : files) {
    SCOPED_TRACE(file.string());
    const auto bytes = bytes_of(file);
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

// As the fuzzer's first input is.
TEST(Corpus, AnEmptyInputRunsThrough) {
  EXPECT_EQ(LLVMFuzzerTestOneInput(nullptr, 0), 0);
}

}  // namespace
