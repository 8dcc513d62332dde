#include "app/workstation/monitor/pose_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace dottrack::monitor {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

bool has(std::uint16_t bits, unsigned bit) {
  return ((unsigned{bits} >> bit) & 1U) != 0;
}

// The cameras of each word, the words in the order of their first cameras.
template <class WordOf>
std::string by_word(std::span<const dottrack_light> lights, WordOf word_of) {
  std::vector<std::pair<std::string_view, std::uint16_t>> cameras;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!lights[i].known) continue;
    const std::string_view word = word_of(lights[i]);
    auto found = std::find_if(cameras.begin(), cameras.end(),
                              [&](const auto& entry) { return entry.first == word; });
    if (found == cameras.end()) found = cameras.insert(found, {word, std::uint16_t{0}});
    found->second = static_cast<std::uint16_t>(found->second | (1U << i));
  }
  std::string words;
  for (const auto& [word, numbers] : cameras) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", word, camera_numbers(numbers));
  }
  return words;
}

}  // namespace

RollPitchYaw roll_pitch_yaw(const double (&q)[4]) {
  const double sine = 2.0 * (q[0] * q[2] - q[3] * q[1]);
  // Where roll and yaw turn about the same axis, the rounding of the quaternion decides.
  constexpr double kUpright = 1.0 - 1e-9;
  if (std::abs(sine) > kUpright) {
    return {.roll_deg = 0.0,
            .pitch_deg = std::copysign(90.0, sine),
            .yaw_deg = 2.0 * kDegrees * std::atan2(q[3], q[0])};
  }
  return {.roll_deg = kDegrees * std::atan2(2.0 * (q[0] * q[1] + q[2] * q[3]),
                                            1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2])),
          .pitch_deg = kDegrees * std::asin(sine),
          .yaw_deg = kDegrees * std::atan2(2.0 * (q[0] * q[3] + q[1] * q[2]),
                                           1.0 - 2.0 * (q[2] * q[2] + q[3] * q[3]))};
}

std::optional<std::array<double, 6>> sigmas(const dottrack_pose& pose) {
  if (!pose.has_covariance) return std::nullopt;
  std::array<double, 6> deviations{};
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    deviations[i] = std::sqrt(pose.covariance[7 * i]);
  }
  return deviations;
}

std::optional<double> age_s(const dottrack_pose& pose) {
  if (pose.age_us == std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return 1e-6 * pose.age_us;
}

std::string degraded_words(std::uint16_t degraded) {
  std::string words;
  for (unsigned bit = 0; bit < 16; ++bit) {
    if (!has(degraded, bit)) continue;
    words += words.empty() ? "" : " ";
    words += dottrack_degraded_text(bit);
  }
  return words.empty() ? "-" : words;
}

std::string camera_numbers(std::uint16_t cameras) {
  std::string numbers;
  for (unsigned first = 0; first < DOTTRACK_MAX_CAMERAS; ++first) {
    if (!has(cameras, first)) continue;
    unsigned last = first;
    while (last + 1 < DOTTRACK_MAX_CAMERAS && has(cameras, last + 1)) ++last;
    if (!numbers.empty()) numbers += ',';
    numbers += fmt::format("{}", first + 1);
    if (last > first) numbers += fmt::format("-{}", last + 1);
    first = last;
  }
  return numbers.empty() ? "-" : numbers;
}

std::string health_words(const dottrack_pose& pose) {
  constexpr std::uint8_t kAbsent = 0;
  constexpr std::uint8_t kMoved = 7;
  std::string words;
  for (std::uint8_t health = kAbsent + 1; health <= kMoved; ++health) {
    unsigned cameras = 0;
    for (unsigned i = 0; i < DOTTRACK_MAX_CAMERAS; ++i) {
      if (pose.camera_health[i] == health) cameras |= 1U << i;
    }
    if (cameras == 0) continue;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", dottrack_health_text(health),
                         camera_numbers(static_cast<std::uint16_t>(cameras)));
  }
  return words.empty() ? "-" : words;
}

std::string light_words(std::span<const dottrack_light> lights) {
  const std::string states =
      by_word(lights, [](const dottrack_light& light) { return dottrack_light_text(light.state); });
  if (states.empty()) return {};
  return states + "; iris " + by_word(lights, [](const dottrack_light& light) {
           return dottrack_iris_text(light.iris);
         });
}

std::string verdict_words(dottrack_verdict verdict, const dottrack_pose* pose) {
  const bool no_pose = verdict == DOTTRACK_FRESH && pose != nullptr && !pose->valid;
  return std::string(dottrack_verdict_text(verdict)) + (no_pose ? ", no pose" : "");
}

std::string unit_words(const dottrack_unit& unit) {
  if (!unit.has_version && !unit.has_configuration) return "not told yet";
  std::string words;
  if (unit.has_version) {
    words = fmt::format("{}.{}.{}, protocol {}", unit.major, unit.minor, unit.patch, unit.protocol);
  }
  if (unit.has_configuration) {
    words += fmt::format("{}configuration {:08X}, target {}, {} cameras", words.empty() ? "" : ", ",
                         unit.config_hash, unit.target, unit.cameras);
  }
  return words;
}

std::string seconds_text(Duration time) {
  const auto us = std::chrono::floor<std::chrono::microseconds>(time).count();
  return fmt::format("{}.{:06}", us / 1000000, us % 1000000);
}

}  // namespace dottrack::monitor
