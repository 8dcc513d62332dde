// Whatever a message holds, its group is whole, consistent and within the DBC's ranges.

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "app/core/protocol/dbc_layout.h"
#include "app/core/protocol/e2e.h"
#include "tests/unit/protocol/dbc_reading.h"
#include "tests/unit/protocol/random_message.h"

namespace dottrack::protocol::test {
namespace {

double odd_number(std::mt19937_64& random) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::array kOdd{std::numeric_limits<double>::quiet_NaN(),
                            kInf,
                            -kInf,
                            0.0,
                            -0.0,
                            1e300,
                            -1e300,
                            1e-310,
                            839.0,
                            -33.0};
  return kOdd.at(random() % kOdd.size());
}

void spoil(double& number, std::mt19937_64& random) {
  if (random() % 8 == 0) number = odd_number(random);
}

void spoil_pose(PoseMessage& message, std::mt19937_64& random) {
  spoil(message.position_m[static_cast<int>(random() % 3)], random);
  spoil(message.orientation.coeffs()[static_cast<int>(random() % 4)], random);
  spoil(message.residual_m, random);
  spoil(message.false_lock_probability, random);
  spoil((*message.velocity_m_s)[static_cast<int>(random() % 3)], random);
  spoil((*message.rates_rad_s)[static_cast<int>(random() % 3)], random);
  spoil((*message.covariance)(static_cast<int>(random() % 6), static_cast<int>(random() % 6)),
        random);
  for (DotReport& dot : message.dots) {
    spoil(dot.position_m[static_cast<int>(random() % 3)], random);
    spoil(dot.sigma_m, random);
  }
}

PoseMessage odd_message(std::mt19937_64& random) {
  PoseMessage message = random_message(random);
  spoil_pose(message, random);
  message.pose_valid = random() % 4 != 0;
  message.dots_known = static_cast<std::uint8_t>(random() % 20);
  message.dots_used = static_cast<std::uint8_t>(random());
  message.mid_exposure = Time(Duration(static_cast<std::int64_t>(random())));
  message.age = Duration(static_cast<std::int64_t>(random()) >> (random() % 64U));
  if (random() % 8 == 0) message.covariance.reset();
  if (random() % 8 == 0) message.velocity_m_s.reset();
  if (random() % 8 == 0) message.rates_rad_s.reset();
  return message;
}

std::string out_of_range(const Reading& reading) {
  for (const auto& [name, decoded] : reading.signals()) {
    if (decoded.text == "not available") continue;
    const dbc::DbcSignal& signal = *decoded.signal;
    const bool within =
        decoded.physical >= signal.minimum - 1e-9 && decoded.physical <= signal.maximum + 1e-9;
    if (!within) return name;
  }
  return "";
}

// Of these signals either all are available or none is.
void expect_all_or_none(const Reading& reading, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    ASSERT_EQ(reading.available(name), reading.available(names[0])) << name;
  }
}

void check_vectors(const Reading& reading, bool is_fd) {
  const auto of = [&](const std::string& message, const std::string& signal) {
    return is_fd ? "FdPose." + signal : message + "." + signal;
  };
  const std::vector<std::string> place{of("Position", "X"),     of("Position", "Y"),
                                       of("Position2", "Z"),    of("Position2", "QW"),
                                       of("Orientation", "QX"), of("Orientation", "QY"),
                                       of("Orientation", "QZ")};
  expect_all_or_none(reading, place);
  const bool valid = reading(of("Status", "PoseValid")) == 1;
  ASSERT_EQ(reading.available(place[0]), valid);
  ASSERT_FALSE(valid && reading(of("Status", "OutOfRange")) == 1);
  expect_all_or_none(reading, {"Velocity.VX", "Velocity.VY", "Velocity.VZ"});
  expect_all_or_none(reading, {"Rates.WX", "Rates.WY", "Rates.WZ"});
  ASSERT_TRUE(valid || !reading.available("Velocity.VX"));
  ASSERT_TRUE(valid || !reading.available(of("Quality", "FalseLock")));
}

void check_covariance(const Reading& reading, bool is_fd) {
  std::set<bool> seen;
  for (const auto& [name, decoded] : reading.signals()) {
    const bool part = name.find(".Corr") != std::string::npos ||
                      (name.find(".Sigma") != std::string::npos && !name.starts_with("Dot"));
    if (part) seen.insert(decoded.text != "not available");
  }
  ASSERT_EQ(seen.size(), 1U);
  if (is_fd) {
    ASSERT_EQ(seen.contains(true), reading("FdPose.CovarianceFollows") == 1);
  }
}

TEST(WholeGroup, OfAnyMessageIsConsistentAndWithinTheRangesOfTheDbc) {
  std::mt19937_64 random(1);
  int valid = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const PoseMessage message = odd_message(random);
    for (const bool is_fd : {false, true}) {
      const GroupFrames frames = encoded(message, is_fd ? fd() : classic(), kAllParts);
      const unsigned dots = std::min<unsigned>(message.dots_known, 16);
      ASSERT_EQ(frames.size(), (is_fd ? 4U : 14U) + 2 * dots);
      const Reading reading(frames);
      ASSERT_EQ(out_of_range(reading), "");
      check_vectors(reading, is_fd);
      check_covariance(reading, is_fd);
      if (testing::Test::HasFatalFailure()) FAIL() << "message " << i;
      const std::string status = is_fd ? "FdPose." : "Status.";
      valid += reading(status + "PoseValid") == 1 ? 1 : 0;
      refused += reading(status + "OutOfRange") == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(valid, 2000);
  EXPECT_GT(refused, 500);
}

TEST(WholeGroup, OneFlippedBitInAnyFrameIsFoundOut) {
  std::mt19937_64 random(2);
  std::size_t flips = 0;
  for (int i = 0; i < 20; ++i) {
    const PoseMessage message = odd_message(random);
    for (const bool is_fd : {false, true}) {
      for (hal::CanFrame frame : encoded(message, is_fd ? fd() : classic(), kAllParts)) {
        for (unsigned bit = 0; bit < 8U * frame.length; ++bit) {
          frame.data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
          LongPayload payload;
          for (std::size_t w = 0; w < 8; ++w) payload[w] = to_word(&frame.data[8 * w]);
          const auto data_id = static_cast<std::uint16_t>(frame.id - kDefaultBaseId + 1);
          const bool sound =
              frame.fd ? get(Field{0, 16}, payload[0]) ==
                             e2e::profile5_crc(payload, layout::fd_pose::kMessage.data_id)
                       : get(Field{0, 8}, payload[0]) == e2e::profile2_crc(payload[0], data_id);
          ASSERT_FALSE(sound) << frame.id << " bit " << bit;
          ++flips;
          frame.data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
        }
      }
    }
  }
  EXPECT_GT(flips, 20'000U);
}

}  // namespace
}  // namespace dottrack::protocol::test
