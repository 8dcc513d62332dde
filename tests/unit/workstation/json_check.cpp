#include "tests/unit/workstation/json_check.h"

#include <cctype>
#include <string_view>

namespace dottrack::workstation {
namespace {

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool whole_value() { return value() && (skip_space(), at_ == text_.size()); }

  // Reads an object; the value of `key` lands in `found`.
  bool object(std::string_view key, std::optional<std::string>& found) {
    if (!take('{')) return false;
    if (take('}')) return true;
    do {
      skip_space();
      const std::size_t name = at_;
      if (!string()) return false;
      const bool wanted = text_.substr(name + 1, at_ - name - 2) == key;
      if (!take(':')) return false;
      skip_space();
      const std::size_t start = at_;
      if (!value()) return false;
      if (wanted) found = std::string(text_.substr(start, at_ - start));
    } while (take(','));
    return take('}');
  }

 private:
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool take(char c) {
    skip_space();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool word(std::string_view expected) {
    if (!text_.substr(at_).starts_with(expected)) return false;
    at_ += expected.size();
    return true;
  }
  bool string() {
    if (!take('"')) return false;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (static_cast<unsigned char>(text_[at_]) < 0x20) return false;
      if (text_[at_] == '\\') ++at_;
    }
    return at_ < text_.size() && text_[at_++] == '"';
  }
  bool digits() {
    const std::size_t start = at_;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ > start;
  }
  bool number() {
    word("-");
    if (!digits()) return false;
    if (word(".") && !digits()) return false;
    if (!word("e") && !word("E")) return true;
    if (!word("+")) word("-");
    return digits();
  }
  bool array() {
    if (!take('[')) return false;
    if (take(']')) return true;
    do {
      if (!value()) return false;
    } while (take(','));
    return take(']');
  }
  bool value() {
    skip_space();
    if (at_ == text_.size()) return false;
    std::optional<std::string> unused;
    switch (text_[at_]) {
      case '{':
        return object("", unused);
      case '[':
        return array();
      case '"':
        return string();
      default:
        return word("true") || word("false") || word("null") || number();
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

bool is_json(const std::string& text) {
  return Reader(text).whole_value();
}

std::optional<std::string> json_member(const std::string& text, const std::string& key) {
  std::optional<std::string> found;
  return Reader(text).object(key, found) ? found : std::nullopt;
}

}  // namespace dottrack::workstation
