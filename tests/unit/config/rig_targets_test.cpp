// Several targets in a rig file, and the number that its files have.

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/config/rig_file.h"
#include "tests/unit/config/good_rig.h"
#include "tests/unit/config/mistake.h"

namespace dottrack::config {
namespace {

using test::kGoodRig;
using test::kGoodTarget;
using test::model_text;
using test::replaced;
using test::RigFolder;

constexpr std::string_view kTargets =
    "[[target]]\n"              // 21
    "name = \"rover\"\n"        // 22
    "dots = \"target.csv\"\n"   // 23
    "upright = false\n"         // 24
    "max_step_m = 0.3\n"        // 25
    "[[target]]\n"              // 26
    "name = \"trailer\"\n"      // 27
    "dots = \"trailer.csv\"\n"  // 28
    "\n";                       // 29

std::string rig_of(std::string_view targets) {
  std::string text(kGoodRig);
  const auto from = text.find("[target]");
  return text.replace(from, text.find("[tracking]") - from, targets);
}

class TargetsFolder : public RigFolder {
 public:
  TargetsFolder() {
    write("trailer.csv", std::string(kGoodTarget) + "3,-1.0,0.0,0.5,0.1\n");
    write("rig.toml", rig_of(kTargets));
  }
};

RigConfig load_or_fail(const RigFolder& folder) {
  Result<RigConfig> config = load_rig(folder.rig());
  if (!config) throw std::runtime_error(config.error().message);
  return std::move(*config);
}

TEST(RigTargets, OneIsAListOfOne) {
  const RigConfig config = load_or_fail(RigFolder());
  ASSERT_EQ(config.targets.size(), 1U);
  EXPECT_EQ(config.targets[0].name, "rover");
  EXPECT_EQ(config.target_index, 0U);
  EXPECT_EQ(config.target_name, "rover");
  EXPECT_EQ(config.rig.target.dots.size(), 3U);
}

TEST(RigTargets, TheFirstIsInForce) {
  const RigConfig config = load_or_fail(TargetsFolder());
  ASSERT_EQ(config.targets.size(), 2U);
  EXPECT_EQ(config.target_index, 0U);
  EXPECT_EQ(config.target_name, "rover");
  EXPECT_EQ(config.rig.target.dots.size(), 3U);
  EXPECT_FALSE(config.rig.target.upright);
  EXPECT_EQ(config.rig.target.max_step_m, 0.3);
}

TEST(RigTargets, AnotherCanBePutInForce) {
  const RigConfig config = with_target(load_or_fail(TargetsFolder()), 1);
  EXPECT_EQ(config.target_index, 1U);
  EXPECT_EQ(config.target_name, "trailer");
  EXPECT_EQ(config.rig.target.dots.size(), 4U);
  EXPECT_TRUE(config.rig.target.upright);
  EXPECT_EQ(config.rig.target.max_step_m, 0.2);
  EXPECT_EQ(with_target(config, 0).rig.target.dots.size(), 3U);
}

TEST(RigTargets, TheBusCarriesTheLargest) {
  EXPECT_EQ(can_use(load_or_fail(TargetsFolder())).dots, 4U);
  EXPECT_EQ(can_use(with_target(load_or_fail(TargetsFolder()), 1)).dots, 4U);
}

std::string many(unsigned count) {
  std::string targets;
  for (unsigned i = 0; i < count; ++i) {
    targets += "[[target]]\nname = \"t" + std::to_string(i) + "\"\ndots = \"target.csv\"\n";
  }
  return targets;
}

TEST(RigTargets, MayBeEight) {
  const RigFolder folder;
  folder.write("rig.toml", rig_of(many(8)));
  EXPECT_EQ(load_or_fail(folder).targets.size(), 8U);
}

TEST(RigTargets, MayNotBeNine) {
  const RigFolder folder;
  folder.write("rig.toml", rig_of(many(9)));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:45: 9 targets; expected a table [target], or up to 8 tables [[target]]");
}

class RigTargetsRefuse : public testing::TestWithParam<Mistake> {};

TEST_P(RigTargetsRefuse, WithOneLine) {
  const TargetsFolder folder;
  folder.write("rig.toml", rig_of(replaced(kTargets, GetParam().from, GetParam().to)));
  EXPECT_EQ(complaint_about(folder), "rig.toml" + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, RigTargetsRefuse,
    testing::Values(
        Mistake{"SameName", "trailer\"", "rover\"",
                ":27: name is \"rover\" again, first on line 22; expected a name of its own for "
                "every target"},
        Mistake{"Key", "name = \"trailer\"", "colour = 3",
                ":27: unknown key \"colour\" in [[target]]; expected one of name, dots, upright, "
                "max_step_m, dot_sigma_m, allow_ambiguous"},
        Mistake{"NoDots", "dots = \"trailer.csv\"\n", "",
                ":26: [[target]] has no key \"dots\"; expected a text"},
        Mistake{"DotsMissing", "trailer.csv", "lorry.csv",
                ":28: dots is \"lorry.csv\": no such file; expected a target file, relative to the "
                "rig file"},
        Mistake{"DotsAreAFolder", "trailer.csv", "models",
                ":28: dots is \"models\": is a folder; expected a target file, relative to the rig "
                "file"}),
    name_of);

TEST(RigTargets, AreTables) {
  const RigFolder folder;
  folder.write("rig.toml", "target = 3\n" + rig_of(""));
  EXPECT_EQ(complaint_about(folder),
            "rig.toml:1: target is a whole number; expected a table [target], or up to 8 tables "
            "[[target]]");
}

TEST(RigTargets, AMistakeInTheDotsIsThatOfItsFile) {
  const TargetsFolder folder;
  folder.write("trailer.csv", std::string(kGoodTarget) + "3,0.0,0.0,0.5,0.1\n");
  EXPECT_TRUE(complaint_about(folder).starts_with("trailer.csv:5: ")) << complaint_about(folder);
}

TEST(ConfigHash, IsTheChecksumOfTheFilesOneAfterTheOther) {
  const RigFolder folder;
  EXPECT_EQ(load_or_fail(folder).config_hash, load_or_fail(folder).config_hash);
  EXPECT_EQ(load_or_fail(folder).config_hash, load_or_fail(RigFolder()).config_hash);
}

TEST(ConfigHash, IsAnotherForAnyOtherByte) {
  const TargetsFolder folder;
  std::set<std::uint32_t> hashes{load_or_fail(folder).config_hash};
  const auto change = [&](const char* file, const std::string& text) {
    folder.write(file, text);
    hashes.insert(load_or_fail(folder).config_hash);
  };
  change("rig.toml", rig_of(kTargets) + "#");
  change("cam1.cahv", model_text("Dimensions = 640 481\n"));
  change("models/cam2.cahv", model_text("Dimensions = 2047 2048\n"));
  change("target.csv", replaced(kGoodTarget, "1.0", "1.1"));
  change("trailer.csv", std::string(kGoodTarget) + "3,-1.1,0.0,0.5,0.1\n");
  EXPECT_EQ(hashes.size(), 6U);
}

}  // namespace
}  // namespace dottrack::config
