#include "app/workstation/explainer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/workstation/reason_words.h"

namespace dottrack::workstation {
namespace {

constexpr std::string_view kRow = "    {:<14} {:>9} {:>9} {:>9} {:>8} {:>10} {:>9} {:>8}  {}\n";

std::string_view remark(const core::CameraTick& camera) {
  if (camera.stale) return "the same picture again: left out";
  if (!camera.delivered) return "no image";
  if (camera.overflow) return "more than it can hold: some left out";
  return "";
}

bool searched(const core::TickResult& result) {
  return result.acquisition.pairs_tested > 0 || result.acquisition.dots_matched > 0 ||
         result.has_candidate;
}

// "; refused: 12 behind, 3 size", of the gates that refused any.
std::string refusals(const core::AcquisitionCounts& counts) {
  const std::array<std::pair<std::string_view, std::uint32_t>, 6> gates{
      {{"rays nearly parallel", counts.rejected_collinear},
       {"behind a camera", counts.rejected_behind},
       {"out of distance_m", counts.rejected_distance},
       {"rays miss", counts.rejected_miss},
       {"not a dot's size", counts.rejected_size},
       {"seen elsewhere", counts.rejected_reprojection}}};
  std::string text;
  for (const auto& [gate, count] : gates) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, gate);
  }
  return text.empty() ? "" : "    refused: " + text + "\n";
}

}  // namespace

Explainer::Explainer(const config::RigConfig& config, std::function<void(const std::string&)> say)
    : dots_(config.rig.target.dots.size()),
      max_false_lock_probability_(config.rig.limits.max_false_lock_probability),
      say_(std::move(say)) {
  for (const config::CameraEntry& camera : config.cameras) cameras_.push_back(camera.name);
}

void Explainer::do_write(const telemetry::CycleRecord& record) {
  const core::TickResult& result = record.result;
  if (result.has_pose) {
    finish();
    last_.clear();
    return;
  }
  std::string key = key_of(result);
  if (key == last_) {
    if (same_++ == 0) same_from_ = result.tick;
    least_false_ = std::min(least_false_, result.acquisition.false_lock_probability);
    return;
  }
  finish();
  last_ = std::move(key);
  last_reason_ = result.reason;
  say_(fmt::format("tick {}: {}", result.tick, about(result)));
}

void Explainer::finish() {
  if (same_ == 0) return;
  const std::string best =
      least_false_ < 1.0
          ? fmt::format("; best match of them by chance with probability {:.1e}", least_false_)
          : "";
  const std::string ticks = same_ == 1
                                ? fmt::format("tick {}", same_from_)
                                : fmt::format("ticks {} to {}", same_from_, same_from_ + same_ - 1);
  say_(fmt::format("{}: {} still{}\n", ticks, core::to_string(last_reason_), best));
  same_ = 0;
  least_false_ = 1.0;
}

// What is the same in ticks that are told together.
std::string Explainer::key_of(const core::TickResult& result) const {
  std::string key =
      fmt::format("{} {}", core::to_string(result.state), core::to_string(result.reason));
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    key += result.cameras[i].stale ? 's' : result.cameras[i].delivered ? 'd' : '-';
  }
  return key;
}

std::string Explainer::about(const core::TickResult& result) {
  return fmt::format("no pose: {}, {}\n", core::to_string(result.reason),
                     result.state == core::State::tracking ? "while tracking" : "while acquiring") +
         words(result.reason) + camera_table(result) + acquisition_lines(result);
}

// Once a reason is enough.
std::string Explainer::words(core::Reason reason) {
  const std::uint32_t bit = 1U << static_cast<unsigned>(reason);
  if ((explained_ & bit) != 0) return "";
  explained_ |= bit;
  const ReasonWords words = words_for(reason);
  return fmt::format("  {}\n  What helps: {}\n", words.why, words.remedy);
}

std::string Explainer::camera_table(const core::TickResult& result) const {
  std::string text = fmt::format(kRow, "regions", "found", "not a dot", "not a dot", "left",
                                 "no dot can", "no dot of", "to match", "") +
                     fmt::format(kRow, "of camera", "", "by size", "by shape", "", "be there",
                                 "that tilt", "", "");
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    text += camera_row(cameras_[i], result.cameras[i]);
  }
  return text;
}

// Dashes where nothing was looked at: tracking sees the dots' windows alone, acquisition no dots.
std::string Explainer::camera_row(const std::string& name, const core::CameraTick& camera) const {
  if (!camera.delivered) {
    return fmt::format("    {:<14} {}\n", name, remark(camera));
  }
  const auto count = [](bool known, std::uint32_t n) { return known ? std::to_string(n) : "-"; };
  const bool whole = camera.components > 0 || camera.regions == 0;
  return fmt::format(kRow, name, count(whole, camera.components),
                     count(whole, camera.rejected_size), count(whole, camera.rejected_shape),
                     camera.regions, count(whole, camera.rejected_sight),
                     count(!whole || camera.rejected_ellipse > 0, camera.rejected_ellipse),
                     count(whole, camera.sightings), remark(camera));
}

std::string Explainer::acquisition_lines(const core::TickResult& result) const {
  if (!searched(result)) return "";
  const core::AcquisitionCounts& counts = result.acquisition;
  std::string text =
      fmt::format("    pairs of regions: {} tested, {} accepted; places where dots may be: {}{}\n",
                  counts.pairs_tested, counts.pairs_accepted, counts.finalists,
                  counts.overflow > 0 ? "; more than it can hold: some left out" : "") +
      refusals(counts);
  if (counts.ticks > 1) text += fmt::format("    this search: {} ticks so far\n", counts.ticks);
  if (counts.dots_matched > 0) {
    text += fmt::format(
        "    best match: {} of {} dots, of those that {} cameras or more see; by chance with "
        "probability {:.1e} (a lock: {:.0e} or less)\n",
        counts.dots_matched, dots_, counts.min_views, counts.false_lock_probability,
        max_false_lock_probability_);
  }
  return text;
}

}  // namespace dottrack::workstation
