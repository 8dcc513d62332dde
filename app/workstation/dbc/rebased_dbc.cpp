#include "app/workstation/dbc/rebased_dbc.h"

#include <array>
#include <charconv>
#include <cstdint>

namespace dottrack::dbc {
namespace {

constexpr std::uint32_t kExtendedBit = 0x80000000U;

// What stands before an identifier at the beginning of a line. An attribute's own name stands
// between BA_ and BO_.
constexpr std::array<std::string_view, 4> kBefore{"BO_ ", "CM_ BO_ ", "CM_ SG_ ", "VAL_ "};

// Where a line's identifier begins; npos: it has none.
std::size_t identifier_at(std::string_view line) {
  for (const std::string_view before : kBefore) {
    if (line.starts_with(before)) return before.size();
  }
  constexpr std::string_view kOfMessage = "\" BO_ ";
  const std::size_t found = line.starts_with("BA_ ") ? line.find(kOfMessage) : line.npos;
  return found == line.npos ? line.npos : found + kOfMessage.size();
}

std::string with_identifier_moved(std::string_view line, const protocol::Addressing& addressing) {
  const std::size_t at = identifier_at(line);
  if (at == line.npos) return std::string(line);
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(line.data() + at, line.data() + line.size(), id);
  if (error != std::errc{}) return std::string(line);
  id = id - protocol::kDefaultBaseId + addressing.base_id;
  if (addressing.extended) id |= kExtendedBit;
  return std::string(line.substr(0, at)) + std::to_string(id) +
         std::string(end, line.data() + line.size());
}

void replace(std::string& line, std::string_view old_text, std::string_view new_text) {
  const std::size_t found = line.find(old_text);
  if (found != line.npos) line.replace(found, old_text.size(), new_text);
}

std::string base_text(const protocol::Addressing& addressing) {
  std::array<char, 8> digits{};
  char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), addressing.base_id, 16).ptr;
  std::string text = "0x";
  for (const char* digit = digits.data(); digit != end; ++digit) {
    text += *digit >= 'a' ? static_cast<char>(*digit - 'a' + 'A') : *digit;
  }
  return text + (addressing.extended ? " (29 bits)" : "");
}

// VFrameFormat: 0 StandardCAN, 1 ExtendedCAN, 14 StandardCAN_FD, 15 ExtendedCAN_FD.
void adapt_format(std::string& line) {
  if (line.starts_with("BA_DEF_DEF_ \"VFrameFormat\"")) {
    replace(line, "\"StandardCAN\"", "\"ExtendedCAN\"");
  } else if (line.starts_with("BA_ \"VFrameFormat\" BO_ ")) {
    replace(line, " 14;", " 15;");
    replace(line, " 0;", " 1;");
  }
}

}  // namespace

std::string rebased(std::string_view layout, const protocol::Addressing& addressing) {
  std::string text;
  text.reserve(layout.size() + layout.size() / 8);
  while (!layout.empty()) {
    const std::size_t end = layout.find('\n');
    std::string line = with_identifier_moved(layout.substr(0, end), addressing);
    if (line.starts_with("CM_ \""))
      replace(line, "the base 0x300", "the base " + base_text(addressing));
    if (addressing.extended) adapt_format(line);
    text += line;
    if (end == layout.npos) break;
    text += '\n';
    layout.remove_prefix(end + 1);
  }
  return text;
}

}  // namespace dottrack::dbc
