#include "rtos_shim/spsc_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace dottrack::rtos {
namespace {

TEST(SpscRing, GivesBackWhatItTookInOrder) {
  SpscRing<int, 4> ring;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(ring.try_push(i));
  int value = -1;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(ring.try_pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.try_pop(value));
  EXPECT_EQ(value, 2);
}

TEST(SpscRing, HoldsItsCapacityAndRefusesOneMore) {
  SpscRing<int, 4> ring;
  for (std::size_t i = 0; i < ring.capacity(); ++i) ASSERT_TRUE(ring.try_push(7));
  EXPECT_FALSE(ring.try_push(8));
  int value = 0;
  ASSERT_TRUE(ring.try_pop(value));
  EXPECT_TRUE(ring.try_push(9));
}

// An element too large to be copied at once: a torn copy would show as unequal words.
using Wide = std::array<std::uint64_t, 32>;

Wide wide(std::uint64_t n) {
  Wide element;
  element.fill(n);
  return element;
}

TEST(SpscRing, CarriesEveryElementWholeBetweenTwoThreads) {
  constexpr std::uint64_t kElements = 20000;
  SpscRing<Wide, 8> ring;
  std::thread producer([&ring] {
    for (std::uint64_t n = 0; n < kElements; ++n) {
      while (!ring.try_push(wide(n))) std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 0; n < kElements; ++n) {
    Wide got{};
    while (!ring.try_pop(got)) std::this_thread::yield();
    if (got != wide(n)) ++wrong;
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace dottrack::rtos
