#include "app/workstation/explainer.h"

#include <fmt/format.h>

#include <utility>

#include "app/workstation/reason_words.h"

namespace dottrack::workstation {
namespace {

constexpr std::string_view kRow = "    {:<14} {:>10} {:>10} {:>10} {:>8} {:>10} {:>8}  {}\n";

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

}  // namespace

Explainer::Explainer(const config::RigConfig& config, std::function<void(const std::string&)> say)
    : dots_(config.rig.target.dots.size()),
      max_false_lock_probability_(config.rig.limits.max_false_lock_probability),
      say_(std::move(say)) {
  for (const config::CameraEntry& camera : config.cameras) cameras_.push_back(camera.name);
}

void Explainer::do_write(const telemetry::CycleRecord& record) {
  if (record.result.has_pose) {
    finish();
    last_.clear();
    return;
  }
  std::string text = about(record);
  if (text == last_) {
    if (same_++ == 0) same_from_ = record.result.tick;
    return;
  }
  finish();
  say_(fmt::format("tick {}: {}", record.result.tick, text));
  last_ = std::move(text);
}

void Explainer::finish() {
  if (same_ == 1) say_(fmt::format("tick {}: the same\n", same_from_));
  if (same_ > 1)
    say_(fmt::format("ticks {} to {}: the same\n", same_from_, same_from_ + same_ - 1));
  same_ = 0;
}

std::string Explainer::about(const telemetry::CycleRecord& record) const {
  const core::TickResult& result = record.result;
  const ReasonWords words = words_for(result.reason);
  return fmt::format("no pose: {}, {}\n  {}\n  What helps: {}\n", core::to_string(result.reason),
                     result.state == core::State::tracking ? "while tracking" : "while acquiring",
                     words.why, words.remedy) +
         camera_table(result) + acquisition_lines(result);
}

std::string Explainer::camera_table(const core::TickResult& result) const {
  std::string text =
      fmt::format(kRow, "regions", "found", "not a dot", "not a dot", "left", "no dot can",
                  "matched", "") +
      fmt::format(kRow, "of camera", "", "by size", "by shape", "", "be there", "", "");
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    text += camera_row(cameras_[i], result.cameras[i]);
  }
  return text;
}

// Dashes where nothing was looked at: tracking sees the dots' windows alone.
std::string Explainer::camera_row(const std::string& name, const core::CameraTick& camera) const {
  if (!camera.delivered) {
    return fmt::format("    {:<14} {}\n", name, remark(camera));
  }
  const auto count = [](bool known, std::uint32_t n) { return known ? std::to_string(n) : "-"; };
  const bool whole = camera.components > 0 || camera.regions == 0;
  return fmt::format(kRow, name, count(whole, camera.components),
                     count(whole, camera.rejected_size), count(whole, camera.rejected_shape),
                     camera.regions, count(whole, camera.rejected_sight),
                     count(whole, camera.sightings), remark(camera));
}

std::string Explainer::acquisition_lines(const core::TickResult& result) const {
  if (!searched(result)) return "";
  const core::AcquisitionCounts& counts = result.acquisition;
  std::string text =
      fmt::format("    pairs of regions: {} tested, {} accepted; places where dots may be: {}{}\n",
                  counts.pairs_tested, counts.pairs_accepted, counts.finalists,
                  counts.overflow > 0 ? "; more than it can hold: some left out" : "");
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
