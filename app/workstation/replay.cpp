#include "app/workstation/replay.h"

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/config/rig_file.h"
#include "app/workstation/explainer.h"
#include "app/workstation/loop_files.h"
#include "app/workstation/loop_run.h"
#include "app/workstation/rig_warnings.h"
#include "drivers/recorded/no_iris.h"
#include "drivers/recorded/recorded_frame_grabber.h"

namespace dottrack::workstation {
namespace {

void warn(const std::string& line) {
  std::fprintf(stderr, "dottrack: warning: %s\n", line.c_str());
}

std::vector<drivers::RecordedCamera> recorded_cameras(const config::RigConfig& config) {
  std::vector<drivers::RecordedCamera> cameras;
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const core::Camera& camera = config.rig.cameras[i];
    cameras.push_back({config.cameras[i].name, camera.width_px, camera.height_px});
  }
  return cameras;
}

Result<std::unique_ptr<drivers::RecordedFrameGrabber>> open_frames(const ReplayOptions& options,
                                                                   const config::RigConfig& config,
                                                                   rtos::VirtualClock& clock) {
  auto grabber = drivers::RecordedFrameGrabber::open(
      options.frames, recorded_cameras(config), [&clock](Time until) { clock.jump_to(until); });
  if (!grabber) return grabber;
  for (const std::string& name : (*grabber)->silent_cameras()) {
    warn(fmt::format("{} holds no images; {} will not deliver", (options.frames / name).string(),
                     name));
  }
  return grabber;
}

RunSummary run(const ReplayOptions& options, const config::RigConfig& config,
               drivers::RecordedFrameGrabber& grabber, LoopFiles files) {
  drivers::NoIris iris;
  std::function<ImageView(std::size_t)> image;
  if (options.pictures) image = [&](std::size_t camera) { return grabber.loaded_image(camera); };
  hal::CanBus& can = *files.can_log;
  std::optional<Explainer> explainer;
  LoopRun loop(config, std::move(files), {grabber, iris, can, std::move(image)});
  if (options.explain) loop.add(explainer.emplace(config, options.explain));
  const std::uint64_t ticks =
      grabber.recorded_ticks() + static_cast<std::uint64_t>(options.repeat) - 1;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    for (const std::string& fault : grabber.load(tick)) warn(fault);
    if (!loop.tick()) break;
  }
  if (explainer) explainer->finish();
  RunFacts facts;
  facts.bad_frames = grabber.bad_frames();
  return loop.finish(std::move(facts));
}

}  // namespace

Result<RunSummary> replay(const ReplayOptions& options) {
  if (options.repeat < 1) return fail("--repeat is at least 1");
  const Result<config::RigConfig> config = config::load_rig(options.rig);
  if (!config) return tl::unexpected<Error>(config.error());
  print_warnings(*config);
  auto clock = std::make_unique<rtos::VirtualClock>();
  const auto grabber = open_frames(options, *config, *clock);
  if (!grabber) return tl::unexpected<Error>(grabber.error());
  Result<LoopFiles> files = open_loop_files(options.out, std::move(clock));
  if (!files) return tl::unexpected<Error>(files.error());
  return run(options, *config, **grabber, std::move(*files));
}

}  // namespace dottrack::workstation
