#include "tests/board/harness/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dottrack::board {
namespace {

constexpr unsigned char kFirstPrintable = 0x20;

std::string json_text(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') json += '\\';
    if (static_cast<unsigned char>(c) < kFirstPrintable) {
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      json += c;
    }
  }
  return json + "\"";
}

}  // namespace

void Verdict::add(Finding finding) {
  findings_.push_back(std::move(finding));
}

bool Verdict::all_hold() const {
  return !findings_.empty() &&
         std::all_of(findings_.begin(), findings_.end(), [](const Finding& f) { return f.holds; });
}

std::string Verdict::json() const {
  std::string json = fmt::format("{{\n  \"all_hold\": {},\n  \"findings\": [", all_hold());
  for (std::size_t i = 0; i < findings_.size(); ++i) {
    const Finding& f = findings_[i];
    json += fmt::format("{}\n    {{\"what\": {}, \"holds\": {}, \"figures\": {}}}",
                        i == 0 ? "" : ",", json_text(f.what), f.holds, json_text(f.figures));
  }
  return json + "\n  ]\n}\n";
}

std::string table_line(const Finding& finding) {
  return fmt::format("{:<38} {:<7} {}", finding.what, finding.holds ? "ok" : "FAILED",
                     finding.figures);
}

}  // namespace dottrack::board
