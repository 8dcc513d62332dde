#pragma once
// Looking at pictures.

#include "app/workstation/canvas.h"

namespace dottrack::workstation {

inline bool operator==(const Colour& a, const Colour& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

inline int count(const Canvas& canvas, Colour colour) {
  int found = 0;
  for (int y = 0; y < canvas.height_px(); ++y) {
    for (int x = 0; x < canvas.width_px(); ++x) found += canvas.at(x, y) == colour ? 1 : 0;
  }
  return found;
}

// Is there a pixel of this colour at most `reach_px` columns and rows away?
inline bool near(const Canvas& canvas, const Eigen::Vector2d& at, Colour colour, int reach_px) {
  const int column = static_cast<int>(at.x());
  const int row = static_cast<int>(at.y());
  for (int y = row - reach_px; y <= row + reach_px + 1; ++y) {
    for (int x = column - reach_px; x <= column + reach_px + 1; ++x) {
      const bool inside = x >= 0 && y >= 0 && x < canvas.width_px() && y < canvas.height_px();
      if (inside && canvas.at(x, y) == colour) return true;
    }
  }
  return false;
}

}  // namespace dottrack::workstation
