#include "app/core/tracking/camera_watch.h"

#include <algorithm>
#include <cmath>

namespace dottrack::tracking {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// A gain is what a shift explains: the sum over a camera's dots of the squares of so many pixels.
constexpr double kStepGain_px2 = 0.13;
constexpr double kStep_px = 0.2;
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

CameraWatch::Sum CameraWatch::half(const History& history, bool later) const {
  Sum sum;
  for (std::size_t i = 0; i < kBlocks / 2; ++i) {
    sum.add(history.ring[(history.next + i + (later ? kBlocks / 2 : 0)) % kBlocks]);
  }
  return sum;
}

// True when there is enough of a past to judge by.
bool CameraWatch::end_block(std::size_t camera) {
  History& history = history_[camera];
  history.ring[history.next] = history.block;
  history.next = (history.next + 1) % kBlocks;
  history.blocks = std::min(history.blocks + 1, kBlocks);
  history.block = Sum{};
  if (history.blocks < kBlocks) return false;
  const Sum after = half(history, true);
  judge_step(history, history.step_blocks > 0 ? history.before_step : half(history, false), after);
  judge_shift(history, after);
  return true;
}

void CameraWatch::judge_step(History& history, const Sum& before, const Sum& after) const {
  const Shift then = shift_of(before.evidence, before.ticks);
  const Shift now = shift_of(after.evidence, after.ticks);
  const Vector2d step_px = now.px - then.px;
  history.step_gain = 0.0;
  if (then.known && now.known) {
    history.step_gain = gain_of(step_px, 0.5 * (then.information + now.information));
  }
  if (history.step_gain > kStepGain_px2 && step_px.norm() > kStep_px) {
    history.before_step = before;
    ++history.step_blocks;
  } else {
    history.step_blocks = 0;
  }
}

void CameraWatch::judge_shift(History& history, const Sum& after) const {
  const Shift now = shift_of(after.evidence, after.ticks);
  history.shift_px = now.px;
  history.shift_gain = now.known ? gain_of(now.px, now.information) : 0.0;
  const bool off = history.shift_gain > kShiftGain_px2 && now.px.norm() > kShift_px;
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
    if (moved_.contains(i) || history_[i].blocks < kBlocks) continue;
    ++judged;
    if (history_[i].shift_blocks >= kShiftBlocks) ++off;
  }
  if (off >= kFewestTrusted && 2 * off >= judged) rig_disagrees_ = true;
}

}  // namespace dottrack::tracking
