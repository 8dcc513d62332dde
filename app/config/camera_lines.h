#pragma once
// The lines of a camera file: keys with their text, matrices with their rows, still without
// meaning.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/config/complaint.h"

namespace dottrack::config {

struct CameraRow {
  std::size_t line = 0;
  std::string text;
};

struct CameraItem {
  std::size_t line = 0;
  std::string key;
  std::string value;            // right of the first '='
  std::vector<CameraRow> rows;  // the lines below S = and S internal =
};

struct CameraLines {
  std::vector<CameraItem> items;  // every key at most once
  std::string comment;            // the first comment
  std::size_t last_line = 1;

  const CameraItem* find(std::string_view key) const;
};

// Complains about unknown and repeated keys and about lines that are neither key nor matrix row.
// A first line that is no key is a comment, as some writers have it.
CameraLines split_camera_text(std::string_view text, Complaint& complaint);

// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed_blanks(std::string_view text);

}  // namespace dottrack::config
