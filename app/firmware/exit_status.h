#pragma once

namespace dottrack::firmware {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    // ran, but the job failed
inline constexpr int kWrongUse = 2;  // wrong use or wrong input

}  // namespace dottrack::firmware
