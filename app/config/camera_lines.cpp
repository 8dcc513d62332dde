#include "app/config/camera_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dottrack::config {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::array<std::string_view, 16> kKeys = {
    "Model", "Dimensions", "C",  "A",  "H",  "V",     "O", "R",
    "E",     "Hs",         "Hc", "Vs", "Vc", "Theta", "S", "S internal"};

bool is_matrix(std::string_view key) {
  return key == "S" || key == "S internal";
}

// "S   internal" is "S internal".
std::string single_blanks(std::string_view text) {
  std::string key;
  for (const char c : text) {
    const bool blank = kBlanks.find(c) != std::string_view::npos;
    if (!blank) {
      key += c;
    } else if (key.back() != ' ') {  // the text is trimmed: it starts with no blank
      key += ' ';
    }
  }
  return key;
}

class Splitter {
 public:
  explicit Splitter(Complaint& complaint) : complaint_(complaint) {}

  CameraLines split(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty() && complaint_.empty()) {
      const auto end = text.find('\n');
      ++line_;
      take_line(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    out_.last_line = std::max<std::size_t>(line_, 1);
    return std::move(out_);
  }

 private:
  void take_line(std::string_view line) {
    const auto hash = line.find('#');
    const std::string_view content = trimmed_blanks(line.substr(0, hash));
    if (content.empty()) {
      if (hash != std::string_view::npos) take_comment(line.substr(hash + 1));
      return;
    }
    const auto equals = content.find('=');
    if (equals != std::string_view::npos) {
      take_key(content.substr(0, equals), content.substr(equals + 1));
    } else {
      take_other(content);
    }
  }

  void take_comment(std::string_view text) {
    if (has_comment_) return;
    if (text.starts_with(' ')) text.remove_prefix(1);
    out_.comment = text.substr(0, text.find_last_not_of(kBlanks) + 1);
    has_comment_ = true;
  }

  void take_key(std::string_view left, std::string_view right) {
    const std::string key = single_blanks(trimmed_blanks(left));
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      return complain("unknown key " + in_quotes(key),
                      fmt::format("one of {}", fmt::join(kKeys, ", ")));
    }
    if (const CameraItem* earlier = out_.find(key)) {
      return complain(fmt::format("key {} again, first on line {}", key, earlier->line),
                      "every key once");
    }
    out_.items.push_back({line_, key, std::string(trimmed_blanks(right)), {}});
  }

  void take_other(std::string_view content) {
    if (!out_.items.empty() && is_matrix(out_.items.back().key)) {
      out_.items.back().rows.push_back({line_, std::string(content)});
    } else if (line_ == 1) {
      take_comment(content);
    } else {
      complain(in_quotes(content), "a line like C = 1 2 3");
    }
  }

  void complain(std::string_view what, std::string_view expected) {
    complaint_.add(line_, what, expected);
  }

  Complaint& complaint_;
  CameraLines out_;
  std::size_t line_ = 0;
  bool has_comment_ = false;
};

}  // namespace

std::string_view trimmed_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

const CameraItem* CameraLines::find(std::string_view key) const {
  const auto same = [key](const CameraItem& item) { return item.key == key; };
  const auto found = std::find_if(items.begin(), items.end(), same);
  return found == items.end() ? nullptr : &*found;
}

CameraLines split_camera_text(std::string_view text, Complaint& complaint) {
  return Splitter(complaint).split(text);
}

}  // namespace dottrack::config
