#pragma once
// Letters of 5 x 7 dots, for the legends in pictures.

#include <array>
#include <string_view>

namespace dottrack::workstation {

inline constexpr int kGlyphRows = 7;
inline constexpr int kGlyphColumns = 5;

struct Glyph {
  std::array<std::string_view, kGlyphRows> rows;  // '#' is a dot

  bool dot(int row, int column) const {
    return rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#';
  }
};

// Capitals serve for small letters too; a sign that is not known is a blank.
const Glyph& glyph_of(char letter);

}  // namespace dottrack::workstation
