#include "drivers/recorded/pgm_reader.h"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

namespace dottrack::drivers {
namespace {

bool is_space(int c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
bool is_digit(int c) {
  return c >= '0' && c <= '9';
}

// White space and comments between two words of the header.
void skip_gap(std::istream& in) {
  while (is_space(in.peek()) || in.peek() == '#') {
    if (in.get() != '#') continue;
    while (in.peek() != '\n' && in.peek() != std::istream::traits_type::eof()) in.get();
  }
}

// A whole number of at most nine digits.
std::optional<int> read_number(std::istream& in) {
  skip_gap(in);
  int value = 0;
  int digits = 0;
  for (; is_digit(in.peek()); ++digits) {
    if (digits == 9) return std::nullopt;
    value = value * 10 + (in.get() - '0');
  }
  return digits == 0 ? std::nullopt : std::optional(value);
}

// The header's numbers, or what is wrong with them in a few words.
struct Header {
  PgmSize size;
  std::string fault;
};

Header read_header(std::istream& in) {
  if (in.get() != 'P' || in.get() != '5' || !(is_space(in.peek()) || in.peek() == '#')) {
    return {{}, "does not start with P5"};
  }
  const std::optional<int> width = read_number(in);
  const std::optional<int> height = read_number(in);
  const std::optional<int> maxval = read_number(in);
  if (in.peek() == std::istream::traits_type::eof()) return {{}, "ends inside its header"};
  if (!width || !height || !maxval) return {{}, "its header is not width, height and maxval"};
  if (!is_space(in.get())) return {{}, "its header does not end in one white space"};
  const PgmSize size{*width, *height};
  if (*maxval > 255) return {size, fmt::format("has 16 bits a pixel (maxval {})", *maxval)};
  if (*maxval != 255) return {size, fmt::format("has maxval {}", *maxval)};
  return {size, {}};
}

// A wrong size is said before a wrong maxval.
std::string header_fault(std::istream& in, int width_px, int height_px) {
  const Header header = read_header(in);
  const PgmSize& size = header.size;
  const bool sized = size.width_px > 0 || header.fault.empty();
  if (sized && (size.width_px != width_px || size.height_px != height_px)) {
    return fmt::format("is of {} x {} pixels", size.width_px, size.height_px);
  }
  return header.fault;
}

std::string pixels_fault(std::istream& in, std::span<std::uint8_t> pixels) {
  in.read(reinterpret_cast<char*>(pixels.data()), static_cast<std::streamsize>(pixels.size()));
  const auto got = static_cast<std::size_t>(in.gcount());
  if (got < pixels.size()) {
    return fmt::format("is truncated: {} of {} bytes of pixels", got, pixels.size());
  }
  if (in.peek() != std::istream::traits_type::eof()) return "has bytes after its last pixel";
  return {};
}

std::string fault(const std::filesystem::path& path, int width_px, int height_px,
                  std::span<std::uint8_t> pixels) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return "is not a file";
  std::ifstream in(path, std::ios::binary);
  if (!in) return fmt::format("cannot be opened ({})", std::strerror(errno));
  const std::string header = header_fault(in, width_px, height_px);
  return header.empty() ? pixels_fault(in, pixels) : header;
}

}  // namespace

Result<void> read_pgm(const std::filesystem::path& path, int width_px, int height_px,
                      std::span<std::uint8_t> pixels) {
  assert(pixels.size() == static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  const std::string wrong = fault(path, width_px, height_px, pixels);
  if (wrong.empty()) return {};
  return fail(fmt::format("{} {}; expected a binary PGM (P5) of {} x {} pixels with maxval 255",
                          path.string(), wrong, width_px, height_px));
}

Result<PgmSize> read_pgm_size(const std::filesystem::path& path) {
  constexpr int kMost_px = 32768;
  std::error_code ignored;
  std::string wrong = "is not a file";
  if (std::filesystem::is_regular_file(path, ignored)) {
    std::ifstream in(path, std::ios::binary);
    const Header header = read_header(in);
    const auto sensible = [](int side) { return side > 0 && side <= kMost_px; };
    const bool small = sensible(header.size.width_px) && sensible(header.size.height_px);
    if (in && header.fault.empty() && small) return header.size;
    wrong = !header.fault.empty()
                ? header.fault
                : fmt::format("is of {} x {} pixels", header.size.width_px, header.size.height_px);
  }
  return fail(
      fmt::format("{} {}; expected a binary PGM (P5) with maxval 255", path.string(), wrong));
}

}  // namespace dottrack::drivers
