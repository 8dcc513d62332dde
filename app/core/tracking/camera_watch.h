#pragma once
// Notices, while tracking, that a camera no longer stands as its model says (the paper knows how
// critical good models are, but not how to notice that one has ceased to be).

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "app/core/tracking/shift_evidence.h"
#include "hal/base/camera_set.h"

namespace dottrack::tracking {

// Models are never exact: how far a camera's dots are off differs from place to place, slowly. So
// there are two tests of each camera, over the ticks in which it saw two dots or more: a step,
// against what the same camera saw just before, and a larger shift that was there from the first
// look, against nothing. In both no other camera may look as suspicious, for a camera that is off
// pulls the pose, and with it the others. Decides by the ticks alone, in a fixed order.
class CameraWatch {
 public:
  static constexpr int kFewestTrusted = 3;  // that are never left out

  explicit CameraWatch(std::size_t cameras) : cameras_(cameras) {}

  // After a tick. `evidence`: of the cameras of the rig, with moved() distrusted; empty where there
  // is no pose.
  void look(std::span<const ShiftEvidence> evidence);
  // There was no pose, or another lock: what comes has no past.
  void interrupt();
  // All cameras are trusted again.
  void readmit();

  // Those that have been moved, and are left out.
  CameraSet moved() const { return moved_; }
  // As good as all cameras contradict each other, or one more than can be left out does: the
  // survey, the target or the whole rig is wrong.
  bool rig_disagrees() const { return rig_disagrees_; }
  // How far a camera's dots are off in the last ticks; zero where nothing is known.
  Eigen::Vector2d shift_px(std::size_t camera) const { return history_[camera].shift_px; }

 private:
  static constexpr int kBlockTicks = 5;
  // A stretch of ticks is long enough to average noise, a stretch's way short enough for a model's
  // faults to stay as they are.
  static constexpr std::size_t kStretchBlocks = 2;
  static constexpr std::size_t kPastStretches = 3;
  static constexpr std::size_t kBlocks = kStretchBlocks * (kPastStretches + 1);

  struct Sum {
    ShiftEvidence evidence;
    int ticks = 0;
    void add(const Sum& other);
  };

  using Past = std::array<Sum, kPastStretches>;

  struct History {  // of one camera
    Sum block;      // that is going on
    std::array<Sum, kBlocks> ring{};
    std::size_t next = 0;  // in the ring
    std::size_t blocks = 0;
    int unseen_ticks = 0;
    Past before_step;
    int step_blocks = 0;  // that show a step, one after another
    double step_gain = 0.0;
    int shift_blocks = 0;  // that show the camera far off
    double shift_gain = 0.0;
    Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  };

  void forget(History& history) const;
  bool end_block(std::size_t camera);
  Sum stretch(const History& history, std::size_t which) const;  // from the oldest on
  Past past(const History& history) const;
  void judge_step(History& history, const Sum& now) const;
  void judge_shift(History& history, const Sum& now) const;
  bool stands_out(std::size_t camera, double History::*gain, double ratio) const;
  void leave_out(std::size_t camera);
  void judge_rig();

  std::size_t cameras_;
  std::array<History, kMaxCameras> history_{};
  CameraSet moved_;
  bool rig_disagrees_ = false;
};

}  // namespace dottrack::tracking
