#include "app/core/tracking/camera_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dottrack::tracking {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// A gain is what a shift explains: the sum over a camera's dots of the squares of so many pixels.
constexpr double kStepGain_px2 = 0.07;
constexpr double kStep_px = 0.15;
constexpr double kShiftGain_px2 = 1.2;
constexpr double kShift_px = 0.7;
constexpr double kStandOut = 1.5;  // times the next camera's gain

// Blocks that must show it, one after another: what passes, a person's shadow say, is no move.
constexpr int kStepBlocks = 5;
constexpr int kShiftBlocks = 8;
constexpr int kMostUnseenTicks = 15;  // then a camera's past is too far away
// Of a dot's worth: less in any direction, and the other cameras do not hold the pose.
constexpr double kLeastInformation = 0.1;

double least_eigenvalue(const Matrix2d& m) {
  const double mean = 0.5 * (m(0, 0) + m(1, 1));
  const double half = 0.5 * (m(0, 0) - m(1, 1));
  return mean - std::sqrt(half * half + m(0, 1) * m(0, 1));
}

// A mean over ticks.
struct Shift {
  bool known = false;
  Vector2d px = Vector2d::Zero();
  Matrix2d information = Matrix2d::Zero();
};

Shift shift_of(const ShiftEvidence& sum, int ticks) {
  Shift shift;
  if (ticks == 0) return shift;
  shift.information = sum.information / ticks;
  const double det = sum.information.determinant();
  if (!(least_eigenvalue(shift.information) >= kLeastInformation)) return shift;
  Matrix2d adjugate;
  adjugate << sum.information(1, 1), -sum.information(0, 1), -sum.information(1, 0),
      sum.information(0, 0);
  shift.px = adjugate * sum.score / det;
  shift.known = true;
  return shift;
}

double gain_of(const Vector2d& px, const Matrix2d& information) {
  return px.dot(information * px);
}

}  // namespace

void CameraWatch::Sum::add(const Sum& other) {
  evidence.information += other.evidence.information;
  evidence.score += other.evidence.score;
  ticks += other.ticks;
}

void CameraWatch::forget(History& history) const {
  history = History{};
}

void CameraWatch::interrupt() {
  for (History& history : history_) forget(history);
  rig_disagrees_ = false;
}

void CameraWatch::readmit() {
  moved_ = CameraSet{};
  interrupt();
}

void CameraWatch::look(std::span<const ShiftEvidence> evidence) {
  CameraSet ended;
  for (std::size_t i = 0; i < cameras_; ++i) {
    History& history = history_[i];
    if (evidence.empty() || least_eigenvalue(evidence[i].information) < kLeastInformation) {
      if (++history.unseen_ticks == kMostUnseenTicks) forget(history);
      continue;
    }
    history.unseen_ticks = 0;
    history.block.add({evidence[i], 1});
    if (history.block.ticks == kBlockTicks && end_block(i)) ended.insert(i);
  }
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (!ended.contains(i) || moved_.contains(i)) continue;
    const History& history = history_[i];
    const bool stepped =
        history.step_blocks >= kStepBlocks && stands_out(i, &History::step_gain, kStandOut);
    const bool off =
        history.shift_blocks >= kShiftBlocks && stands_out(i, &History::shift_gain, kStandOut);
    if (!stepped && !off) continue;
    leave_out(i);
    return;
  }
  if (!ended.empty()) judge_rig();
}

CameraWatch::Sum CameraWatch::stretch(const History& history, std::size_t which) const {
  Sum sum;
  for (std::size_t i = 0; i < kStretchBlocks; ++i) {
    sum.add(history.ring[(history.next + which * kStretchBlocks + i) % kBlocks]);
  }
  return sum;
}

CameraWatch::Past CameraWatch::past(const History& history) const {
  Past past;
  for (std::size_t i = 0; i < past.size(); ++i) past[i] = stretch(history, i);
  return past;
}

// True when there is enough to judge by.
bool CameraWatch::end_block(std::size_t camera) {
  History& history = history_[camera];
  history.ring[history.next] = history.block;
  history.next = (history.next + 1) % kBlocks;
  history.blocks = std::min(history.blocks + 1, kBlocks);
  history.block = Sum{};
  if (history.blocks < kStretchBlocks) return false;
  const Sum now = stretch(history, kPastStretches);
  judge_shift(history, now);
  if (history.blocks == kBlocks) judge_step(history, now);
  return true;
}

// Against each stretch of the past: what was otherwise only just before was a shadow that passed.
void CameraWatch::judge_step(History& history, const Sum& now) const {
  if (history.step_blocks == 0) history.before_step = past(history);
  const Shift late = shift_of(now.evidence, now.ticks);
  history.step_gain = std::numeric_limits<double>::max();
  for (const Sum& before : history.before_step) {
    const Shift early = shift_of(before.evidence, before.ticks);
    if (!early.known || !late.known || (late.px - early.px).norm() < kStep_px) {
      history.step_gain = 0.0;
      break;
    }
    const double gain = gain_of(late.px - early.px, 0.5 * (early.information + late.information));
    history.step_gain = std::min(history.step_gain, gain);
  }
  history.step_blocks = history.step_gain > kStepGain_px2 ? history.step_blocks + 1 : 0;
}

void CameraWatch::judge_shift(History& history, const Sum& now) const {
  const Shift shift = shift_of(now.evidence, now.ticks);
  history.shift_px = shift.px;
  history.shift_gain = shift.known ? gain_of(shift.px, shift.information) : 0.0;
  const bool off = history.shift_gain > kShiftGain_px2 && shift.px.norm() > kShift_px;
  history.shift_blocks = off ? history.shift_blocks + 1 : 0;
}

bool CameraWatch::stands_out(std::size_t camera, double History::*gain, double ratio) const {
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (i == camera || moved_.contains(i)) continue;
    if (history_[i].*gain * ratio > history_[camera].*gain) return false;
  }
  return true;
}

void CameraWatch::leave_out(std::size_t camera) {
  if (static_cast<int>(cameras_) - moved_.size() - 1 < kFewestTrusted) {
    rig_disagrees_ = true;
    return;
  }
  moved_.insert(camera);
  // Its pull on the others has ended.
  for (History& history : history_) forget(history);
}

// When half of those that can be judged, and three at least, are far off, no single one is to
// blame.
void CameraWatch::judge_rig() {
  int judged = 0;
  int off = 0;
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (moved_.contains(i) || history_[i].blocks < kStretchBlocks) continue;
    ++judged;
    if (history_[i].shift_blocks >= kShiftBlocks) ++off;
  }
  if (off >= kFewestTrusted && 2 * off >= judged) rig_disagrees_ = true;
}

}  // namespace dottrack::tracking
