#include "app/workstation/loop_files.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace dottrack::workstation {

namespace fs = std::filesystem;

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return fail(fmt::format("{}: cannot make this folder ({})", folder.string(), error.message()));
}

Result<LoopFiles> open_loop_files(const fs::path& out, std::unique_ptr<rtos::VirtualClock> clock) {
  if (const auto made = make_folder(out); !made) return tl::unexpected<Error>(made.error());
  Result<telemetry::OutputFile> tum = telemetry::OutputFile::create(out / "poses.tum");
  if (!tum) return tl::unexpected<Error>(tum.error());
  Result<telemetry::OutputFile> filtered = telemetry::OutputFile::create(out / "filtered.tum");
  if (!filtered) return tl::unexpected<Error>(filtered.error());
  Result<telemetry::OutputFile> csv = telemetry::OutputFile::create(out / "poses.csv");
  if (!csv) return tl::unexpected<Error>(csv.error());
  auto can = drivers::CandumpCanBus::open(out / "can.log", *clock);
  if (!can) return tl::unexpected<Error>(can.error());
  return LoopFiles{out,
                   std::move(*tum),
                   std::move(*filtered),
                   std::move(*csv),
                   std::move(clock),
                   std::move(*can)};
}

}  // namespace dottrack::workstation
