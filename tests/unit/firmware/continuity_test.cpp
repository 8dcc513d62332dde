#include "app/firmware/continuity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace dottrack::firmware {
namespace {

using dottrack::test::TemporaryFolder;

TEST(Continuity, TheFirstStartOfAllCountsFromZero) {
  const TemporaryFolder folder;
  EXPECT_EQ(ContinuityFile(folder.path()).resets_at_start().value(), 0U);
}

TEST(Continuity, LocksCountOnOverARestartAndTheStartIsOne) {
  const TemporaryFolder folder;
  ContinuityFile before(folder.path());
  ASSERT_TRUE(before.keep(41));
  ASSERT_TRUE(before.keep(42));
  EXPECT_EQ(ContinuityFile(folder.path()).resets_at_start().value(), 43U);
}

TEST(Continuity, AFileThatIsNotOursIsTold) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "locks") << "many\n";
  const auto resets = ContinuityFile(folder.path()).resets_at_start();
  ASSERT_FALSE(resets);
  EXPECT_THAT(resets.error().message, testing::HasSubstr("locks: not a number of locks"));
}

TEST(Continuity, AFolderThatIsGoneIsToldWhenWriting) {
  ContinuityFile file(std::filesystem::path("/nonexistent/state"));
  const auto kept = file.keep(3);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, testing::HasSubstr("/nonexistent/state/locks"));
}

TEST(Continuity, WithoutAFolderNothingIsKept) {
  ContinuityFile file(std::nullopt);
  EXPECT_TRUE(file.keep(3));
  EXPECT_EQ(file.resets_at_start().value(), 0U);
}

}  // namespace
}  // namespace dottrack::firmware
