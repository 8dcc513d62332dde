#pragma once
// How the virtual board is wired: the rig file says it to the unit, the harness reads it back.

#include <chrono>
#include <cstddef>

#include "hal/base/time.h"

namespace dottrack::board {

inline constexpr const char* kGpioChip = "iris";  // its label
inline constexpr unsigned kGpioLines = 64;
inline constexpr unsigned kLinesPerIris = 4;  // step, direction, enable, auto: camera by camera
inline constexpr unsigned kTriggerLine = 60;
inline constexpr unsigned kLampLine = 61;

inline constexpr int kIrisTravel_steps = 40;
inline constexpr int kIrisBacklash_steps = 2;
inline constexpr double kIrisRate_steps_per_s = 20.0;
inline constexpr double kIrisOpening = 0.8;  // where the rig file sends every iris
inline constexpr int kIrisOpening_steps = 32;

inline constexpr const char* kRecordingFolder = "/var/lib/dottrack/recording";
inline constexpr double kRecordingFree_mb = 32.0;  // of the disk that stay free
inline constexpr double kWatchdog_s = 15.0;

}  // namespace dottrack::board
