#include "drivers/socketcan/interface_list.h"

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace dottrack::drivers {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::SizeIs;

std::uint32_t rate_by_index(int index) {
  return index == 3 ? 500000U : 0U;
}

// A class/net as sysfs lays it out.
class InterfaceListTest : public testing::Test {
 protected:
  void add(const std::string& name, const char* type, const char* flags, const char* mtu,
           const char* index) const {
    folder_.write(name + "/type", type);
    folder_.write(name + "/flags", flags);
    folder_.write(name + "/mtu", mtu);
    folder_.write(name + "/ifindex", index);
  }
  void add_driver(const std::string& name, const std::string& driver) const {
    const fs::path module = folder_.path() / "drivers" / driver;
    fs::create_directories(module);
    fs::create_directories(folder_.path() / name / "device");
    fs::create_directory_symlink(module, folder_.path() / name / "device" / "driver");
  }

  test::TemporaryFolder folder_;
};

TEST_F(InterfaceListTest, TellsCanInterfacesByNameAndLeavesOutTheRest) {
  add("vcan0", "280\n", "0x400c1\n", "72\n", "5\n");
  add("can0", "280\n", "0x40080\n", "16\n", "3\n");
  add_driver("can0", "kvaser_pci");
  add("eth0", "1\n", "0x1003\n", "1500\n", "2\n");
  folder_.write("bonding_masters", "\n");
  const auto found = can_interfaces_in(folder_.path(), rate_by_index);
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_THAT(*found, SizeIs(2));
  EXPECT_EQ((*found)[0].name, "can0");
  EXPECT_EQ((*found)[0].driver, "kvaser_pci");
  EXPECT_FALSE((*found)[0].up);
  EXPECT_FALSE((*found)[0].fd);
  EXPECT_EQ((*found)[0].bit_rate, 500000U);
  EXPECT_EQ((*found)[1].name, "vcan0");
  EXPECT_EQ((*found)[1].driver, "");
  EXPECT_TRUE((*found)[1].up);
  EXPECT_TRUE((*found)[1].fd);
  EXPECT_EQ((*found)[1].bit_rate, 0U);
}

TEST_F(InterfaceListTest, AMissingFolderIsAnErrorThatNamesIt) {
  const auto found = can_interfaces_in(folder_.path() / "none", rate_by_index);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr((folder_.path() / "none").string()));
}

TEST(InterfaceList, ThisMachinesCanBeListed) {
  EXPECT_TRUE(list_can_interfaces());
}

}  // namespace
}  // namespace dottrack::drivers
