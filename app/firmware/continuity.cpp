#include "app/firmware/continuity.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

namespace dottrack::firmware {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "locks";

}  // namespace

ContinuityFile::ContinuityFile(std::optional<fs::path> folder) {
  if (folder) file_ = *folder / kName;
}

ContinuityFile ContinuityFile::of_service() {
  const char* folder = std::getenv("STATE_DIRECTORY");
  if (folder == nullptr || *folder == '\0') return ContinuityFile(std::nullopt);
  return ContinuityFile(fs::path(folder));
}

Result<std::uint32_t> ContinuityFile::resets_at_start() const {
  if (!file_ || !fs::exists(*file_)) return 0U;
  std::ifstream in(*file_);
  std::uint32_t resets = 0;
  if (!(in >> resets)) return fail(file_->string() + ": not a number of locks; counting from 0");
  return resets + 1;
}

Result<void> ContinuityFile::keep(std::uint32_t resets) {
  if (!file_ || kept_ == resets) return {};
  const fs::path fresh = file_->string() + ".new";
  {
    std::ofstream out(fresh, std::ios::trunc);
    out << resets << '\n';
    if (!out.flush()) return fail(fresh.string() + ": cannot be written");
  }
  std::error_code error;
  fs::rename(fresh, *file_, error);
  if (error) return fail(file_->string() + ": cannot be replaced: " + error.message());
  kept_ = resets;
  return {};
}

}  // namespace dottrack::firmware
