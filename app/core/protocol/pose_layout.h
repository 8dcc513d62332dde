#pragma once
// Which bits of which frame carry what. dottrack.dbc says the same in its own language; a test
// holds the two together. Byte 0 of every frame is 0, kept for a checksum; the group counter lies
// where it lies in every frame.

#include "app/core/protocol/can_payload.h"

namespace dottrack::protocol::layout {

enum FrameIndex : unsigned { kStatus = 0, kTime = 1, kPose1 = 2, kPose2 = 3, kPose3 = 4 };

inline constexpr Field kCounter{8, 4};  // the same in all frames of a group

// kStatus
inline constexpr Field kVersion{12, 4};
inline constexpr Field kState{16, 2};
inline constexpr Field kPoseValid{18, 1};
inline constexpr Field kOutOfRange{19, 1};
inline constexpr Field kReason{24, 8};
inline constexpr Field kCamerasUsed{32, 16};
inline constexpr Field kDotsUsed{48, 5};
inline constexpr Field kResetCount{56, 8};
// kTime
inline constexpr Field kMidExposureUs{16, 48};
// kPose1
inline constexpr Field kX{16, 24};
inline constexpr Field kY{40, 24};
// kPose2
inline constexpr Field kZ{16, 24};
inline constexpr Field kQw{40, 17};
// kPose3
inline constexpr Field kQx{12, 17};
inline constexpr Field kQy{29, 17};
inline constexpr Field kQz{46, 17};

inline constexpr double kPositionStepsPerMetre = 10000.0;  // 0.1 mm
// A step of 2e-5: four components rounded by half a step turn the attitude by at most
// 2 * sqrt(4) * 1e-5 rad = 0.0023 degrees.
inline constexpr double kQuaternionSteps = 50000.0;

}  // namespace dottrack::protocol::layout
