#include "app/config/text_file.h"

#include <fstream>
#include <system_error>

namespace dottrack::config {

Result<std::string> read_text_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return fail("no such file");
  if (std::filesystem::is_directory(path, ignored)) return fail("is a folder");
  std::ifstream in(path, std::ios::binary);
  std::string text(kMaxTextBytes + 1, '\0');
  if (!in) return fail("cannot be read");
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) return fail("cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMaxTextBytes) return fail("is larger than 1 MiB");
  return text;
}

}  // namespace dottrack::config
