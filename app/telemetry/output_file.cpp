#include "app/telemetry/output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace dottrack::telemetry {
namespace {

namespace fs = std::filesystem;

fs::path part_of(const fs::path& path) {
  return path.string() + ".part";
}

tl::unexpected<Error> cannot_write(const fs::path& path, int reason) {
  return fail(fmt::format("{}: cannot write ({})", path.string(), std::strerror(reason)));
}

}  // namespace

Result<OutputFile> OutputFile::create(const fs::path& path) {
  File file(std::fopen(part_of(path).c_str(), "wb"));
  if (!file) return cannot_write(path, errno);
  return OutputFile(path, std::move(file));
}

OutputFile::OutputFile(fs::path path, File file) : path_(std::move(path)), file_(std::move(file)) {}

OutputFile::~OutputFile() {
  if (!file_) return;
  std::error_code ignored;
  fs::remove(part_of(path_), ignored);
}

void OutputFile::write(std::string_view bytes) {
  if (failed()) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    first_errno_ = errno;
  }
}

Result<void> OutputFile::flush() {
  if (!failed() && std::fflush(file_.get()) != 0) first_errno_ = errno;
  if (failed()) return cannot_write(path_, first_errno_);
  return {};
}

Result<void> OutputFile::finish() {
  if (auto flushed = flush(); !flushed) return flushed;
  file_.reset();
  std::error_code error;
  fs::rename(part_of(path_), path_, error);
  if (error) return cannot_write(path_, error.value());
  return {};
}

Result<void> write_file(const fs::path& path, std::string_view bytes) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return tl::unexpected<Error>(file.error());
  file->write(bytes);
  return file->finish();
}

}  // namespace dottrack::telemetry
