#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/telemetry/pose_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of.h"
#include "tests/unit/telemetry/record_of.h"

namespace dottrack::telemetry {
namespace {

TEST(TumWriter, WritesATickWithAPoseAndLeavesOutTheOthers) {
  const test::TemporaryFolder folder;
  auto file = OutputFile::create(folder.path() / "poses.tum");
  ASSERT_TRUE(file);
  TumWriter writer(*file);
  writer.write(record_without_pose(0));
  writer.write(record_with_pose(1));
  ASSERT_TRUE(file->finish());
  EXPECT_EQ(text_of(folder.path() / "poses.tum"),
            "1.500000001 1.250000000 -0.500000000 0.100000000 "
            "-0.500000000 0.500000000 0.500000000 0.500000000\n");
}

}  // namespace
}  // namespace dottrack::telemetry
