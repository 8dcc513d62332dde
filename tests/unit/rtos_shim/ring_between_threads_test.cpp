#include <gtest/gtest.h>
#include <sched.h>

#include <cstdint>

#include "rtos_shim/posix_rt/posix_thread.h"
#include "rtos_shim/spsc_ring.h"

namespace dottrack::rtos {
namespace {

ThreadSettings named(const char* name) {
  ThreadSettings settings;
  settings.name = name;
  return settings;
}

TEST(SpscRing, CarriesAMillionNumbersInOrderFromOneThreadToAnother) {
  constexpr std::uint64_t kNumbers = 1'000'000;
  SpscRing<std::uint64_t, 1024> ring;
  std::uint64_t out_of_order = 0;
  PosixThread producer;
  PosixThread consumer;
  ASSERT_TRUE(consumer.start(named("consumer"), [&] {
    for (std::uint64_t n = 0; n < kNumbers; ++n) {
      std::uint64_t got = 0;
      while (!ring.try_pop(got)) sched_yield();
      if (got != n) ++out_of_order;
    }
  }));
  ASSERT_TRUE(producer.start(named("producer"), [&] {
    for (std::uint64_t n = 0; n < kNumbers; ++n) {
      while (!ring.try_push(n)) sched_yield();
    }
  }));
  producer.join();
  consumer.join();
  EXPECT_EQ(out_of_order, 0U);
}

}  // namespace
}  // namespace dottrack::rtos
