#include "app/config/complaint.h"

#include <fmt/format.h>

namespace dottrack::config {
namespace {

std::string on_one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) c = '?';
  }
  return line;
}

}  // namespace

void Complaint::add(std::size_t line, std::string_view what, std::string_view expected) {
  const std::string where = line == 0 ? file_ : fmt::format("{}:{}", file_, line);
  add(Error{on_one_line(fmt::format("{}: {}; expected {}", where, what, expected))});
}

void Complaint::add(Error error) {
  if (!first_) first_ = std::move(error);
}

std::string in_quotes(std::string_view text) {
  return fmt::format("\"{}\"", on_one_line(text));
}

std::string shortest(double number) {
  return fmt::format("{}", number);
}

}  // namespace dottrack::config
