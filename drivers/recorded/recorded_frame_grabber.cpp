#include "drivers/recorded/recorded_frame_grabber.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <system_error>
#include <utility>

#include "drivers/recorded/pgm_reader.h"

namespace dottrack::drivers {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 6;

std::string file_name(std::uint64_t tick) {
  return fmt::format("{:06}.pgm", tick);
}

std::optional<std::uint64_t> tick_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const bool six_digits =
      stem.size() == kDigits &&
      std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (file.extension() != ".pgm" || !six_digits) return std::nullopt;
  return std::stoull(stem);
}

// The numbers of the images in a folder, ascending; none when there is no such folder.
std::vector<std::uint64_t> ticks_in(const fs::path& folder) {
  std::vector<std::uint64_t> ticks;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (const auto tick = tick_of(entry.path())) ticks.push_back(*tick);
  }
  std::sort(ticks.begin(), ticks.end());
  return ticks;
}

std::size_t pixels_of(const RecordedCamera& camera) {
  return static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
}

}  // namespace

RecordedFrameGrabber::RecordedFrameGrabber(const fs::path& folder,
                                           std::vector<RecordedCamera> cameras,
                                           WaitUntil wait_until)
    : wait_until_(std::move(wait_until)) {
  assert(cameras.size() <= kMaxCameras);
  for (RecordedCamera& camera : cameras) {
    std::vector<std::uint8_t> pixels(pixels_of(camera));
    fs::path own = folder / camera.name;
    sources_.push_back({std::move(camera), std::move(own), std::move(pixels), false, false, {}});
  }
}

Result<std::unique_ptr<RecordedFrameGrabber>> RecordedFrameGrabber::open(
    const fs::path& folder, std::vector<RecordedCamera> cameras, WaitUntil wait_until) {
  std::unique_ptr<RecordedFrameGrabber> grabber(
      new RecordedFrameGrabber(folder, std::move(cameras), std::move(wait_until)));
  std::error_code ignored;
  if (fs::exists(folder / "times.csv", ignored)) {
    auto times = FrameTimesTable::read(folder / "times.csv");
    if (!times) return tl::unexpected<Error>(times.error());
    grabber->times_ = std::move(*times);
  }
  std::string first_fault;
  bool readable = false;
  for (Source& source : grabber->sources_) {
    const std::vector<std::uint64_t> ticks = ticks_in(source.folder);
    source.has_images = !ticks.empty();
    if (!source.has_images) continue;
    grabber->recorded_ticks_ = std::max(grabber->recorded_ticks_, ticks.back() + 1);
    for (auto tick = ticks.begin(); tick != ticks.end() && !readable; ++tick) {
      const auto read = read_pgm(source.folder / file_name(*tick), source.camera.width_px,
                                 source.camera.height_px, source.pixels);
      readable = read.has_value();
      if (!read && first_fault.empty()) first_fault = read.error().message;
    }
  }
  if (readable) return grabber;
  if (!first_fault.empty()) return fail("no image can be read: " + first_fault);
  return fail(fmt::format("{} holds no images of the rig's cameras; expected {}", folder.string(),
                          (folder / "<camera>/<tick, six digits>.pgm").string()));
}

std::vector<std::string> RecordedFrameGrabber::silent_cameras() const {
  std::vector<std::string> names;
  for (const Source& source : sources_) {
    if (!source.has_images) names.push_back(source.camera.name);
  }
  return names;
}

std::vector<std::string> RecordedFrameGrabber::load(std::uint64_t tick) {
  const std::uint64_t shown = std::min(tick, recorded_ticks_ - 1);
  std::vector<std::string> faults;
  shown_again_ = shown != tick;
  if (shown == loaded_tick_) return faults;
  loaded_tick_ = shown;
  for (Source& source : sources_) {
    std::string fault = load_source(source, shown);
    source.loaded = source.loaded && fault.empty();
    if (!fault.empty()) faults.push_back(std::move(fault));
  }
  bad_frames_ += faults.size();
  return faults;
}

// What is wrong with the image; empty when nothing is, or when there is none.
std::string RecordedFrameGrabber::load_source(Source& source, std::uint64_t tick) {
  const fs::path file = source.folder / file_name(tick);
  std::error_code ignored;
  source.loaded = fs::exists(file, ignored);
  if (!source.loaded) return {};
  const auto read = read_pgm(file, source.camera.width_px, source.camera.height_px, source.pixels);
  if (!read) return read.error().message;
  if (!times_) return {};
  const auto times = times_->find(tick, source.camera.name);
  if (!times) return fmt::format("{} has no line in times.csv", file.string());
  source.times = *times;
  return {};
}

ImageView RecordedFrameGrabber::loaded_image(std::size_t camera) const {
  const Source& source = sources_[camera];
  if (!source.loaded) return {};
  return {source.pixels.data(), source.camera.width_px, source.camera.height_px,
          source.camera.width_px};
}

void RecordedFrameGrabber::do_trigger(Time now) {
  exposed_ = CameraSet{};
  set_.delivered = CameraSet{};
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    hal::Frame& frame = set_.frames[i];
    frame.image = loaded_image(i);
    frame.mid_exposure = times_ && !shown_again_ ? source.times.mid_exposure : now;
    arrivals_[i] = frame.mid_exposure + (source.times.arrival - source.times.mid_exposure);
    ++frame.sequence;
    if (source.loaded) exposed_.insert(i);
  }
}

const hal::FrameSet& RecordedFrameGrabber::do_await(CameraSet expected, Time deadline) {
  set_.delivered = CameraSet(static_cast<std::uint16_t>(exposed_.bits() & expected.bits()));
  if (times_ && wait_until_) wait_until_(await_times(expected, deadline));
  exposed_ = CameraSet{};
  return set_;
}

// Until when an await took; frames that came later are taken out of the set.
Time RecordedFrameGrabber::await_times(CameraSet expected, Time deadline) {
  Time last{};
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!expected.contains(i)) continue;
    const bool came = set_.delivered.contains(i) && arrivals_[i] <= deadline;
    if (!came) set_.delivered.erase(i);
    last = std::max(last, came ? arrivals_[i] : deadline);
  }
  return last;
}

}  // namespace dottrack::drivers
