// `dottrack replay` on photographs of a real target among real clutter, with known truth.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <ostream>

#include "tests/support/shared_data.h"
#include "tests/unit/workstation/replay_run.h"

namespace dottrack::workstation {
namespace {

namespace fs = std::filesystem;

// What an independent pipeline reached on each case, as its README says; a correct program is
// within three times that.
struct RealCase {
  std::string name;
  double position_error_m;
  double attitude_error_deg;
};
void PrintTo(const RealCase& real, std::ostream* out) {
  *out << real.name;
}

struct Truth {
  Eigen::Vector3d position_m;
  Eigen::Quaterniond orientation;
};

Truth read_truth(const fs::path& path) {
  const std::vector<std::string> lines = lines_of(path);
  if (lines.at(0) != "px,py,pz,qw,qx,qy,qz")
    throw std::runtime_error("columns of " + path.string());
  std::vector<double> n;
  for (const std::string& field : split(lines.at(1), ',')) n.push_back(std::stod(field));
  return {{n.at(0), n.at(1), n.at(2)}, Eigen::Quaterniond(n.at(3), n.at(4), n.at(5), n.at(6))};
}

class RealTarget : public testing::TestWithParam<RealCase> {};

TEST_P(RealTarget, LocksAtTheFirstTickAndTracksEveryLaterOne) {
  const auto shared = test::shared_data();
  if (!shared) GTEST_SKIP() << "shared data absent: photographs of a real target";
  const fs::path folder = *shared / "real_target" / GetParam().name;
  const test::TemporaryFolder outs;
  const fs::path& out = outs.path();
  const ReplayRun run =
      run_replay({(folder / "rig.toml").string(), "--frames", (folder / "frames").string(), "--out",
                  out.string(), "--repeat", "20"});
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(test::only_warnings(run.err)) << run.err;
  EXPECT_EQ(report_of(out, "ticks"), "20");
  EXPECT_EQ(report_of(out, "first_lock_tick"), "0");
  EXPECT_EQ(report_of(out, "tracking_ticks"), "20");
  EXPECT_EQ(report_of(out, "reacquisitions"), "0");
  EXPECT_EQ(report_of(out, "allocations_in_loop"), "0");

  const Truth truth = read_truth(folder / "truth.csv");
  const std::vector<std::string> poses = lines_of(out / "poses.tum");
  ASSERT_EQ(poses.size(), 20U);
  for (const std::string& line : poses) {
    std::vector<double> n;
    for (const std::string& field : split(line, ' ')) n.push_back(std::stod(field));
    ASSERT_EQ(n.size(), 8U);
    const Eigen::Vector3d position(n[1], n[2], n[3]);
    const Eigen::Quaterniond orientation(n[7], n[4], n[5], n[6]);
    EXPECT_LT((position - truth.position_m).norm(), 3 * GetParam().position_error_m);
    EXPECT_LT(orientation.angularDistance(truth.orientation) * 57.29577951308232,
              3 * GetParam().attitude_error_deg);
  }
}

INSTANTIATE_TEST_SUITE_P(Replay, RealTarget,
                         testing::Values(RealCase{"myptv_n5", 0.061e-3, 0.090},
                                         RealCase{"myptv_n8", 0.031e-3, 0.039}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace dottrack::workstation
