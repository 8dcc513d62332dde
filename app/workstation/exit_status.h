#pragma once
// What the program ends with.

namespace dottrack::workstation {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;    // ran, but the job failed
inline constexpr int kWrongUse = 2;  // wrong use or wrong input

}  // namespace dottrack::workstation
