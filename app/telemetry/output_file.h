#pragma once
// A file of results: complete under its name, or not there.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "hal/base/result.h"

namespace dottrack::telemetry {

// Writes beside the file, to a name with `.part` added; finish() gives it its name. An older file
// of that name stays until then. What is not finished is removed.
class OutputFile {
 public:
  static Result<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&&) = default;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  // After a failure nothing more is written; finish() tells what the first one was.
  void write(std::string_view bytes);
  bool failed() const { return first_errno_ != 0; }
  // What was written so far is the system's to keep. An error names the file and the reason.
  Result<void> flush();
  // The same, and gives the file its name.
  Result<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Close>;

  OutputFile(std::filesystem::path path, File file);

  std::filesystem::path path_;
  File file_;
  int first_errno_ = 0;
};

// The whole file in one go.
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace dottrack::telemetry
