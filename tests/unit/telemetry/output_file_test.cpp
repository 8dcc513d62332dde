#include "app/telemetry/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"

namespace dottrack::telemetry {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputFiles : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "result.txt";
};

TEST_F(OutputFiles, AFinishedFileIsThereWhole) {
  auto file = OutputFile::create(path_);
  ASSERT_TRUE(file);
  file->write("one ");
  file->write("two\n");
  EXPECT_FALSE(fs::exists(path_));
  ASSERT_TRUE(file->finish());
  EXPECT_EQ(text_of(path_), "one two\n");
}

TEST_F(OutputFiles, AnUnfinishedFileLeavesTheOlderOneAndNoTrace) {
  ASSERT_TRUE(write_file(path_, "older"));
  {
    auto file = OutputFile::create(path_);
    ASSERT_TRUE(file);
    file->write("newer");
  }
  EXPECT_EQ(text_of(path_), "older");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(OutputFiles, AFolderThatIsNotThereIsAnError) {
  const auto file = OutputFile::create(folder_.path() / "none" / "result.txt");
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().message, HasSubstr("none/result.txt: cannot write (No such file"));
}

// The largest file that this process may write, for as long as the object lives: a disk that fills.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(OutputFiles, ADiskThatFillsIsOneLineAndNoHalfFile) {
  auto file = OutputFile::create(path_);
  ASSERT_TRUE(file);
  {
    const FullDisk full(100000);
    const std::string block(10000, 'x');
    for (int i = 0; i < 20; ++i) file->write(block);
    EXPECT_TRUE(file->failed());
    const Result<void> finished = file->finish();
    ASSERT_FALSE(finished);
    EXPECT_THAT(finished.error().message, HasSubstr("result.txt: cannot write (File too large)"));
  }
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(OutputFiles, ADiskThatFillsInTheLastMomentIsAnErrorToo) {
  auto file = OutputFile::create(path_);
  ASSERT_TRUE(file);
  const FullDisk full(10);
  file->write(std::string(100, 'x'));
  EXPECT_FALSE(file->failed());  // still in memory
  EXPECT_FALSE(file->finish());
}

}  // namespace
}  // namespace dottrack::telemetry
