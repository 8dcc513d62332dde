#include "drivers/libcamera/doorbell.h"

#include <gtest/gtest.h>

#include <thread>

namespace dottrack::drivers {
namespace {

constexpr Duration kForEver = std::chrono::hours(1);

TEST(Doorbell, ThatRangBeforeIsNotWaitedFor) {
  Doorbell bell;
  ASSERT_TRUE(bell.open());
  bell.ring();
  bell.ring();
  bell.wait(kForEver);
  bell.wait(std::chrono::milliseconds(1));  // one wait took both
}

TEST(Doorbell, IsNotWaitedForWithoutPatience) {
  Doorbell bell;
  ASSERT_TRUE(bell.open());
  bell.wait(Duration::zero());
  bell.wait(-kForEver);
}

TEST(Doorbell, WakesAnotherThread) {
  Doorbell bell;
  ASSERT_TRUE(bell.open());
  std::thread ringer([&] { bell.ring(); });
  bell.wait(kForEver);
  ringer.join();
}

}  // namespace
}  // namespace dottrack::drivers
