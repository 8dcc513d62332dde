#include "drivers/libgpiod/iris_mailbox.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace dottrack::test {
namespace {

using drivers::IrisMailbox;
using drivers::MotorPhase;

TEST(IrisMailbox, StartsWithTheLensInCharge) {
  const IrisMailbox mailbox;
  EXPECT_FALSE(mailbox.newest().request.target_steps);
  EXPECT_TRUE(mailbox.view().answered);
}

TEST(IrisMailbox, AnAnswerKnowsItsRequest) {
  IrisMailbox mailbox;
  mailbox.ask(7);
  EXPECT_FALSE(mailbox.view().answered);
  mailbox.answer(mailbox.newest().number, {7, MotorPhase::at_rest});
  EXPECT_TRUE(mailbox.view().answered);
  mailbox.ask(8);
  EXPECT_FALSE(mailbox.view().answered);
  EXPECT_EQ(mailbox.view().status.position_steps, 7);
}

TEST(IrisMailbox, AReleaseShowsEvenIfARequestFollowsAtOnce) {
  IrisMailbox mailbox;
  mailbox.ask(7);
  const auto before = mailbox.newest().request;
  mailbox.ask(std::nullopt);
  mailbox.ask(7);
  EXPECT_NE(mailbox.newest().request, before);
}

TEST(IrisMailbox, TheSameAgainIsNoNewRequest) {
  IrisMailbox mailbox;
  mailbox.ask(7);
  const auto number = mailbox.newest().number;
  mailbox.ask(7);
  EXPECT_EQ(mailbox.newest().number, number);
}

// Every status has as many steps as its phase says; a torn one would not.
TEST(IrisMailbox, NobodySeesHalfAnAnswer) {
  constexpr int kAnswers = 20'000;
  IrisMailbox mailbox;
  std::atomic<bool> done = false;
  std::thread motor([&] {
    for (int i = 0; i < kAnswers; ++i) {
      const bool odd = i % 2 == 1;
      mailbox.answer(mailbox.newest().number,
                     {odd ? 0x7FFFFFFF : 0, odd ? MotorPhase::at_rest : MotorPhase::released});
    }
    done = true;
  });
  int torn = 0;
  for (int target = 0; !done; target = (target + 1) % 1000) {
    mailbox.ask(target);
    const IrisMailbox::Status status = mailbox.view().status;
    const int whole = status.phase == MotorPhase::at_rest ? 0x7FFFFFFF : 0;
    torn += status.position_steps == whole ? 0 : 1;
  }
  motor.join();
  EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace dottrack::test
