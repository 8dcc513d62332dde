#include "rtos_shim/posix_rt/service_manager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "rtos_shim/posix_rt/monotonic_clock.h"

namespace dottrack::rtos {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

// A service manager that only listens.
class ServiceManagerTest : public testing::Test {
 protected:
  ServiceManagerTest() {
    std::string folder = testing::TempDir() + "dottrack-XXXXXX";
    EXPECT_NE(mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = (folder_ / "notify").string();
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(bind(ear_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~ServiceManagerTest() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
    std::filesystem::remove_all(folder_);
  }
  std::string heard() const {
    std::array<char, 1024> words{};
    const ssize_t count = read(ear_.get(), words.data(), words.size());
    return count > 0 ? std::string(words.data(), static_cast<std::size_t>(count)) : "";
  }

  std::filesystem::path folder_;
  FileDescriptor ear_{socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
};

TEST_F(ServiceManagerTest, HearsWhatItIsTold) {
  const ServiceManager manager;
  manager.ready();
  EXPECT_EQ(heard(), "READY=1");
  manager.kick();
  EXPECT_EQ(heard(), "WATCHDOG=1");
  manager.stopping();
  EXPECT_EQ(heard(), "STOPPING=1");
}

TEST_F(ServiceManagerTest, AStatusIsOneLine) {
  ServiceManager().status("tracking\nREADY=1");
  EXPECT_EQ(heard(), "STATUS=tracking READY=1");
}

TEST_F(ServiceManagerTest, ReloadingIsToldWithTheTime) {
  const auto us = [](Time t) { return t.time_since_epoch() / std::chrono::microseconds(1); };
  const long long before = us(MonotonicClock().now());
  ServiceManager().reloading();
  const long long after = us(MonotonicClock().now());
  const std::string told = heard();
  const std::string prefix = "RELOADING=1\nMONOTONIC_USEC=";
  ASSERT_THAT(told, StartsWith(prefix));
  const long long at = std::atoll(told.c_str() + prefix.size());
  EXPECT_GE(at, before);
  EXPECT_LE(at, after);
}

TEST_F(ServiceManagerTest, TellsHowLongItWaitsForAKick) {
  setenv("WATCHDOG_USEC", "1500000", 1);
  EXPECT_EQ(ServiceManager().watchdog_period(), milliseconds(1500));
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(ServiceManager().watchdog_period(), milliseconds(1500));
}

TEST_F(ServiceManagerTest, WaitsForNoKickUnlessItAsksThisProcess) {
  EXPECT_EQ(ServiceManager().watchdog_period(), std::nullopt);
  setenv("WATCHDOG_USEC", "1500000", 1);
  setenv("WATCHDOG_PID", std::to_string(getpid() + 1).c_str(), 1);
  EXPECT_EQ(ServiceManager().watchdog_period(), std::nullopt);
}

TEST_F(ServiceManagerTest, AKickToASocketThatIsGoneDoesNothing) {
  const ServiceManager manager;
  std::filesystem::remove_all(folder_);
  manager.kick();
  EXPECT_EQ(heard(), "");
}

TEST_F(ServiceManagerTest, WithoutOneNothingIsSaid) {
  setenv("WATCHDOG_USEC", "1500000", 1);
  for (const char* address : {"", "@", "nonsense"}) {
    setenv("NOTIFY_SOCKET", address, 1);
    EXPECT_FALSE(ServiceManager().is_listening());
  }
  unsetenv("NOTIFY_SOCKET");
  const ServiceManager manager;
  EXPECT_FALSE(manager.is_listening());
  EXPECT_EQ(manager.watchdog_period(), std::nullopt);
  manager.ready();
  manager.reloading();
  manager.status("nobody hears this");
  manager.stopping();
  manager.kick();
  EXPECT_EQ(heard(), "");
}

}  // namespace
}  // namespace dottrack::rtos
