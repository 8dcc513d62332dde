// The receiver and dottrack.dbc agree about every signal, read by a decoder that knows the file
// only.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "app/workstation/dbc/dbc_file.h"
#include "app/workstation/dbc/dottrack_dbc.h"
#include "tests/unit/receiver/frame_builder.h"
#include "tests/unit/receiver/listener.h"

namespace dottrack::receiver_test {
namespace {

const dbc::DbcFile& layout() {
  static const dbc::DbcFile kFile = dbc::parse_dbc(dbc::dottrack_dbc(), "dottrack.dbc").value();
  return kFile;
}

// Everything the frames say by the DBC: signals by name, those of the dots by "Dot1Position.X".
class Said {
 public:
  explicit Said(const Frames& frames) {
    for (const dottrack_frame& frame : frames) add(frame);
  }

  double physical(const std::string& name) { return use(name).physical; }
  bool available(const std::string& name) { return use(name).text != "not available"; }
  bool has(const std::string& name) const { return signals_.count(name) != 0; }
  std::size_t unused() const {
    return static_cast<std::size_t>(std::count_if(
        signals_.begin(), signals_.end(), [](const auto& entry) { return !entry.second.used; }));
  }
  std::size_t size() const { return signals_.size(); }

 private:
  struct Entry {
    double physical = 0.0;
    std::string text;
    bool used = false;
  };

  void add(const dottrack_frame& frame) {
    hal::CanFrame can;
    can.id = frame.id;
    can.fd = frame.length > 8;
    can.length = frame.length;
    std::copy_n(frame.data, 64, can.data.begin());
    const auto decoded = dbc::decode(layout(), can);
    ASSERT_TRUE(decoded) << frame.id;
    const std::string message = layout().find(frame.id, false)->name.substr(9);
    const bool dot = message.starts_with("Dot");
    for (const dbc::DecodedSignal& signal : *decoded) {
      const std::string& name = signal.signal->name;
      if (name == "CRC") continue;
      const bool common = name == "Sequence";
      signals_[dot && !common ? message + "." + name : name] = {signal.physical,
                                                                std::string(signal.text), false};
    }
  }

  const Entry& use(const std::string& name) {
    const auto found = signals_.find(name);
    if (found == signals_.end()) {
      ADD_FAILURE() << "the DBC has no " << name;
      return none_;
    }
    found->second.used = true;
    return found->second;
  }

  std::map<std::string, Entry> signals_;
  Entry none_;
};

template <std::size_t N>
bool all_available(Said& said, const std::array<const char*, N>& names) {
  unsigned available = 0;
  for (const char* name : names) available += said.available(name) ? 1U : 0U;
  return available == N;
}

void compare_vector(Said& said, const std::array<const char*, 3>& names, bool has,
                    const double* vector) {
  ASSERT_EQ(all_available(said, names), has);
  for (std::size_t i = 0; i < 3 && has; ++i) {
    ASSERT_DOUBLE_EQ(said.physical(names[i]), vector[i]) << names[i];
  }
}

void compare_status(Said& said, const dottrack_pose& pose) {
  EXPECT_EQ(said.physical("Sequence"), pose.sequence);
  EXPECT_EQ(said.physical("Version"), DOTTRACK_PROTOCOL_VERSION);
  EXPECT_EQ(said.physical("State"), pose.state);
  EXPECT_EQ(said.physical("PoseValid"), pose.valid ? 1.0 : 0.0);
  EXPECT_EQ(said.physical("OutOfRange"), pose.out_of_range ? 1.0 : 0.0);
  EXPECT_EQ(said.physical("Reason"), pose.reason);
  EXPECT_EQ(said.physical("CamerasUsed"), pose.cameras_used);
  EXPECT_EQ(said.physical("DotsUsed"), pose.dots_used);
  EXPECT_EQ(said.physical("PoseKind"), pose.kind);
  EXPECT_EQ(said.physical("ResetCount"), pose.reset_count);
  EXPECT_EQ(said.physical("MidExposure"), static_cast<double>(pose.capture_us));
  EXPECT_NEAR(said.physical("Age") * 1e6, pose.age_us, 1e-3);
  EXPECT_EQ(said.physical("Degraded"), pose.degraded);
  EXPECT_EQ(said.physical("DotsFollow"), pose.dots);
  EXPECT_EQ(said.physical("MotionFollows") != 0.0, said.has("VX"));
  EXPECT_EQ(said.physical("CamerasFollow") != 0.0, pose.has_cameras);
}

void compare_quality(Said& said, const dottrack_pose& pose) {
  if (said.available("FalseLock") && pose.valid) {
    EXPECT_EQ(std::ldexp(1.0, -static_cast<int>(said.physical("FalseLock"))),
              pose.false_lock_probability);
  } else {
    EXPECT_LT(pose.false_lock_probability, 0.0);
  }
  if (said.available("Residual") && pose.valid) {
    EXPECT_DOUBLE_EQ(said.physical("Residual"), pose.residual_m);
  } else {
    EXPECT_LT(pose.residual_m, 0.0);
  }
}

void compare_pose(Said& said, const dottrack_pose& pose) {
  compare_vector(said, {"X", "Y", "Z"}, pose.valid, pose.position_m);
  constexpr std::array kNames{"QW", "QX", "QY", "QZ"};
  ASSERT_EQ(all_available(said, kNames), pose.valid);
  double norm = 0.0;
  for (const char* name : kNames) norm += said.physical(name) * said.physical(name);
  for (std::size_t i = 0; i < 4 && pose.valid; ++i) {
    ASSERT_NEAR(said.physical(kNames[i]) / std::sqrt(norm), pose.orientation_wxyz[i], 4e-9);
  }
}

void compare_covariance(Said& said, const dottrack_pose& pose) {
  constexpr std::array kAxes{"X", "Y", "Z", "Roll", "Pitch", "Yaw"};
  const bool follows = said.physical("CovarianceFollows") != 0.0;
  if (!said.has("SigmaX")) {
    ASSERT_FALSE(follows || pose.has_covariance);
    return;
  }
  bool available = follows && pose.valid;
  for (unsigned i = 0; i < 6; ++i) {
    const std::string sigma = std::string("Sigma") + kAxes[i];
    available = said.available(sigma) && available;
    for (unsigned k = i + 1; k < 6; ++k) {
      available = said.available(std::string("Corr") + kAxes[i] + kAxes[k]) && available;
    }
  }
  ASSERT_EQ(available, pose.has_covariance);
  for (unsigned i = 0; i < 6 && available; ++i) {
    for (unsigned k = i; k < 6; ++k) {
      const double correlation =
          i == k ? 1.0 : said.physical(std::string("Corr") + kAxes[i] + kAxes[k]);
      const double expected = correlation * said.physical(std::string("Sigma") + kAxes[i]) *
                              said.physical(std::string("Sigma") + kAxes[k]);
      ASSERT_NEAR(pose.covariance[6 * i + k], expected, 1e-15);
      ASSERT_EQ(pose.covariance[6 * k + i], pose.covariance[6 * i + k]);
    }
  }
}

void compare_rest(Said& said, const dottrack_pose& pose) {
  if (said.has("VX")) {
    compare_vector(said, {"VX", "VY", "VZ"}, pose.has_velocity, pose.velocity_m_s);
    compare_vector(said, {"WX", "WY", "WZ"}, pose.has_rates, pose.rates_rad_s);
  }
  for (unsigned i = 0; i < 16 && pose.has_cameras; ++i) {
    EXPECT_EQ(said.physical("Camera" + std::to_string(i + 1)), pose.camera_health[i]);
  }
  for (unsigned i = 0; i < pose.dots; ++i) {
    const std::string dot = "Dot" + std::to_string(i + 1);
    const std::string x = dot + "Position.X";
    const std::string y = dot + "Position.Y";
    const std::string z = dot + "Detail.Z";
    compare_vector(said, {x.c_str(), y.c_str(), z.c_str()}, pose.dot[i].has_position,
                   pose.dot[i].position_m);
    EXPECT_EQ(said.physical(dot + "Detail.Cameras"), pose.dot[i].cameras);
    EXPECT_EQ(said.physical(dot + "Detail.Visibility"), pose.dot[i].visibility);
    const bool known = said.available(dot + "Detail.Sigma");
    EXPECT_DOUBLE_EQ(pose.dot[i].sigma_m, known ? said.physical(dot + "Detail.Sigma") : -1.0);
  }
}

TEST(ReceiverAgreesWithTheDbc, AboutEverySignalOfRandomGroups) {
  std::mt19937_64 random(1);
  std::size_t compared = 0;
  for (unsigned i = 0; i < 2100; ++i) {
    const Frames frames = frames_of(random_group(random, i % 2 == 1));
    Listener listener;
    ASSERT_EQ(listener.push(frames, 12345), DOTTRACK_FRESH);
    Said said(frames);
    compare_status(said, listener.pose());
    compare_quality(said, listener.pose());
    compare_pose(said, listener.pose());
    compare_covariance(said, listener.pose());
    compare_rest(said, listener.pose());
    ASSERT_EQ(said.unused(), 0U);
    compared += said.size();
    if (HasFailure()) return;
  }
  EXPECT_GE(compared, 150'000U);
}

TEST(ReceiverAgreesWithTheDbc, AboutIdentity) {
  std::mt19937_64 random(2);
  for (unsigned i = 0; i < 500; ++i) {
    dottrack_frame version = random_frame(random, kVersion);
    put_bits(version, 16, 8, DOTTRACK_PROTOCOL_VERSION);
    seal(version);
    const dottrack_frame configuration = random_frame(random, kConfiguration);
    Listener listener;
    ASSERT_EQ(listener.push(version, 0), DOTTRACK_WAITING);
    ASSERT_EQ(listener.push(configuration, 0), DOTTRACK_WAITING);
    Said said({version, configuration});
    const dottrack_unit& unit = listener.unit();
    EXPECT_EQ(said.physical("Protocol"), unit.protocol);
    EXPECT_EQ(said.physical("Major"), unit.major);
    EXPECT_EQ(said.physical("Minor"), unit.minor);
    EXPECT_EQ(said.physical("Patch"), unit.patch);
    EXPECT_NEAR(said.physical("GroupPeriod") * 1e6, unit.group_period_us, 1e-3);
    EXPECT_EQ(said.physical("ConfigHash"), unit.config_hash);
    EXPECT_EQ(said.physical("Target"), unit.target);
    EXPECT_EQ(said.physical("Cameras"), unit.cameras);
    ASSERT_EQ(said.unused(), 1U);  // Sequence
  }
}

TEST(ReceiverAgreesWithTheDbc, AboutCommandsAndReplies) {
  std::mt19937_64 random(3);
  const dottrack_settings settings = dottrack_default_settings();
  for (unsigned i = 0; i < 500; ++i) {
    const dottrack_frame frame = random_frame(random, kReply);
    dottrack_reply reply{};
    ASSERT_TRUE(dottrack_read_reply(&settings, &frame, &reply));
    Said said({frame});
    EXPECT_EQ(said.physical("Command"), reply.command);
    EXPECT_EQ(said.physical("Result"), reply.result);
    EXPECT_EQ(said.physical("Token"), reply.token);
    EXPECT_EQ(said.physical("Accepted"), reply.accepted);
    EXPECT_EQ(said.physical("Rejected"), reply.rejected);
    const auto argument = static_cast<std::uint8_t>(random());
    const auto token = static_cast<std::uint16_t>(random());
    Said asked(
        {dottrack_command_frame(&settings, DOTTRACK_COMMAND_SET_TARGET, argument, token, 9)});
    EXPECT_EQ(asked.physical("Command"), DOTTRACK_COMMAND_SET_TARGET);
    EXPECT_EQ(asked.physical("Argument"), argument);
    EXPECT_EQ(asked.physical("Token"), token);
    EXPECT_EQ(asked.physical("Sequence"), 9.0);
  }
}

void compare_light(const dottrack_frame& frame) {
  Listener listener;
  ASSERT_EQ(listener.push(frame, 77), DOTTRACK_WAITING);
  Said said({frame});
  const auto camera = static_cast<unsigned>(said.physical("Camera"));
  ASSERT_LT(camera, 16U);
  const dottrack_light& light = listener.light(camera);
  ASSERT_TRUE(light.known);
  ASSERT_EQ(said.physical("LightState"), light.state);
  ASSERT_EQ(said.physical("Iris"), light.iris);
  const auto of = [&](const char* name, double most) {
    const bool there = said.available(name) && said.physical(name) <= most + 1e-9;
    return there ? said.physical(name) : -1.0;
  };
  ASSERT_DOUBLE_EQ(of("Exposure", 1.048574), light.exposure_s);
  ASSERT_DOUBLE_EQ(of("Gain", 40.94), light.gain);
  ASSERT_DOUBLE_EQ(of("Opening", 1.0), light.opening);
  ASSERT_EQ(said.unused(), 1U);  // Sequence
}

TEST(ReceiverAgreesWithTheDbc, AboutLight) {
  std::mt19937_64 random(4);
  unsigned none = 0;
  for (unsigned i = 0; i < 2000; ++i) {
    dottrack_frame frame = random_frame(random, kLight);
    const bool blank = i % 8 == 0;
    if (blank) put_bits(frame, 25, 39, ~std::uint64_t{0});
    seal(frame);
    none += blank ? 1U : 0U;
    compare_light(frame);
    if (HasFailure()) return;
  }
  EXPECT_EQ(none, 250U);
}

TEST(ReceiverAgreesWithTheDbc, AboutTheWordsOfEveryNumber) {
  std::size_t words = 0;
  const auto compare = [&](const char* message, const char* signal, auto text) {
    for (const auto& [number, word] :
         layout().find(std::string_view(message))->signal(signal)->values) {
      EXPECT_EQ(word, text(static_cast<std::uint8_t>(number))) << signal << ' ' << number;
      ++words;
    }
  };
  compare("DOTTRACK_Status", "State", dottrack_state_text);
  compare("DOTTRACK_Status", "Reason", dottrack_reason_text);
  compare("DOTTRACK_FdPose", "Reason", dottrack_reason_text);
  compare("DOTTRACK_Cameras", "Camera16", dottrack_health_text);
  compare("DOTTRACK_Status", "PoseKind", dottrack_kind_text);
  compare("DOTTRACK_FdPose", "PoseKind", dottrack_kind_text);
  compare("DOTTRACK_Reply", "Result", dottrack_result_text);
  compare("DOTTRACK_Light", "LightState", dottrack_light_text);
  compare("DOTTRACK_Light", "Iris", dottrack_iris_text);
  EXPECT_EQ(words, 2U + 16U + 16U + 8U + 4U + 4U + 6U + 7U + 4U);
}

}  // namespace
}  // namespace dottrack::receiver_test
