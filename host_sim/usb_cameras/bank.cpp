#include "host_sim/usb_cameras/bank.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <utility>

#include "rtos_shim/posix_rt/system_error.h"

namespace dottrack::host_sim {

Result<std::unique_ptr<UsbCameraBank::Bank>> UsbCameraBank::Bank::open(const UsbCameraSetup& setup,
                                                                       PictureSource pictures,
                                                                       Ports ports) {
  rtos::FileDescriptor wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake.is_open()) {
    return fail(fmt::format("USB cameras: cannot make an event: {}", rtos::reason_of(errno)));
  }
  return std::unique_ptr<Bank>(
      new Bank(setup, std::move(pictures), std::move(ports), std::move(wake)));
}

UsbCameraBank::Bank::Bank(const UsbCameraSetup& setup, PictureSource pictures, Ports ports,
                          rtos::FileDescriptor wake)
    : setup_(setup),
      ports_(std::move(ports)),
      wake_(std::move(wake)),
      grid_(setup.frame_rate_hz),
      conditions_(ports_.size()),
      worker_(std::move(pictures)) {
  publish();
  thread_ = std::thread([this] { run(); });
}

UsbCameraBank::Bank::~Bank() {
  tell([](Bank& bank) { bank.ending_ = true; });
  thread_.join();
}

void UsbCameraBank::Bank::tell(Command command) {
  {
    const std::scoped_lock lock(mutex_);
    commands_.push_back(std::move(command));
  }
  // An event that is full wakes as well.
  [[maybe_unused]] const int ignored = ::eventfd_write(wake_.get(), 1);
}

std::vector<Barrier> UsbCameraBank::Bank::barriers() const {
  const std::scoped_lock lock(mutex_);
  return barriers_;
}

std::uint64_t UsbCameraBank::Bank::late_barriers() const {
  const std::scoped_lock lock(mutex_);
  return late_;
}

UsbCameraBank::Bank::Condition UsbCameraBank::Bank::condition(std::size_t camera) const {
  const std::scoped_lock lock(mutex_);
  return conditions_.at(camera);
}

void UsbCameraBank::Bank::run() {
  while (!ending_) {
    wait();
    obey();
    if (running_) keep_time();
    send();
    publish();
  }
}

void UsbCameraBank::Bank::wait() {
  std::vector<pollfd> interests;
  for (const auto& port : ports_) interests.push_back(port->interest());
  interests.push_back({wake_.get(), POLLIN, 0});
  const Duration left = std::max(grid_.next() - clock_.now(), Duration::zero());
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec timeout{whole.count(), (left - whole).count()};
  const int answered =
      ::ppoll(interests.data(), interests.size(), running_ ? &timeout : nullptr, nullptr);
  if (answered <= 0) return;
  for (std::size_t i = 0; i < ports_.size(); ++i) ports_[i]->serve(interests[i].revents);
}

void UsbCameraBank::Bank::obey() {
  eventfd_t ignored = 0;
  if (::eventfd_read(wake_.get(), &ignored) != 0) return;
  std::vector<Command> commands;
  {
    const std::scoped_lock lock(mutex_);
    commands.swap(commands_);
  }
  for (const Command& command : commands) command(*this);
}

void UsbCameraBank::Bank::start() {
  if (std::exchange(running_, true)) return;
  grid_.start(clock_.now());
  if (ordered_.empty()) order_pictures();
}

void UsbCameraBank::Bank::keep_time() {
  const Time now = clock_.now();
  const std::uint64_t instants = grid_.passed(now);
  if (instants == 0) return;
  const bool ready = worker_.ready();
  if (!anyone_streams()) {
    if (ready) refresh_pictures();
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    late_ += instants - (ready ? 1 : 0);
  }
  if (ready) release(now);
}

bool UsbCameraBank::Bank::anyone_streams() const {
  return std::any_of(ports_.begin(), ports_.end(),
                     [](const auto& port) { return port->streaming(); });
}

std::vector<hal::ExposureSettings> UsbCameraBank::Bank::settings() const {
  std::vector<hal::ExposureSettings> settings;
  for (const auto& port : ports_) settings.push_back(port->exposure());
  return settings;
}

void UsbCameraBank::Bank::order_pictures() {
  ordered_ = settings();
  std::vector<Exposure> exposures;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    Exposure exposure;
    exposure.middle_s = static_cast<double>(next_barrier_) / setup_.frame_rate_hz;
    exposure.duration_s = to_seconds(ordered_[i].exposure);
    exposure.gain = ordered_[i].gain;
    exposure.noise = {setup_.seed, i, next_barrier_};
    exposures.push_back(exposure);
  }
  worker_.ask(std::move(exposures));
}

// Pictures that have waited for a camera to stream are of settings that may have changed since.
void UsbCameraBank::Bank::refresh_pictures() {
  const std::vector<hal::ExposureSettings> now = settings();
  const bool same = std::equal(
      now.begin(), now.end(), ordered_.begin(), ordered_.end(),
      [](const auto& a, const auto& b) { return a.exposure == b.exposure && a.gain == b.gain; });
  if (same) return;
  worker_.take();
  order_pictures();
}

void UsbCameraBank::Bank::release(Time now) {
  const Pictures pictures = worker_.take();
  assert(pictures->size() == ports_.size());
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    assert(pictures->at(i).width_px() == setup_.width_px);
    assert(pictures->at(i).height_px() == setup_.height_px);
    // Shares the ownership of all of them.
    if (ports_[i]->streaming()) ports_[i]->show({pictures, &pictures->at(i)});
  }
  const double scene_time_s = static_cast<double>(next_barrier_) / setup_.frame_rate_hz;
  {
    const std::scoped_lock lock(mutex_);
    barriers_.push_back({next_barrier_, scene_time_s, now});
  }
  ++next_barrier_;
  order_pictures();
}

// In turn: the first piece of every camera leaves before the second of any.
void UsbCameraBank::Bank::send() {
  bool sent = true;
  while (sent) {
    sent = false;
    for (const auto& port : ports_) sent = port->send_piece() || sent;
  }
}

void UsbCameraBank::Bank::publish() {
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const CameraPort& port = *ports_[i];
    conditions_[i] = {port.frames_sent(), port.frames_skipped(), port.streaming(), port.exposure()};
  }
}

}  // namespace dottrack::host_sim
