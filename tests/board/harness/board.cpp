#include "tests/board/harness/board.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "host_sim/scenarios/scene_renderer.h"
#include "host_sim/usb_cameras/scene_cameras.h"
#include "tests/board/harness/host_clock.h"

namespace dottrack::board {
namespace {

using std::chrono::seconds;

constexpr auto kBootPatience = seconds(180);
constexpr auto kCommandPatience = seconds(60);
constexpr int kTimeQuestions = 20;
constexpr double kNarrowestOpening = 0.05;  // what light the blades let through when closed

// By the serial number that the emulator gives the disk: the guest need not have named it yet.
constexpr const char* kSetUp =
    "disk=$(basename $(dirname $(grep -lx observer /sys/block/vd*/serial))) && "
    "mkdir -p /run/observer && mount -o ro /dev/$disk /run/observer && "
    "sh /run/observer/set_up.sh";

// The kernel's monotonic clock, in nanoseconds; the shell itself reads it, which takes least time.
constexpr const char* kAskTime =
    "while read -r a b c d; do [ \"$a\" = now ] && echo $c && break; done </proc/timer_list";

// The cameras' pictures through lenses whose blades are where the board's motors have put them.
host_sim::PictureSource through_irises(host_sim::PictureSource pictures, const GpioBench& gpio) {
  return [pictures = std::move(pictures), &gpio](std::span<const host_sim::Exposure> exposures,
                                                 std::vector<host_sim::GreyImage>& images) {
    std::vector<host_sim::Exposure> seen(exposures.begin(), exposures.end());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      seen[i].opening *= std::max(gpio.iris(i).opening(), kNarrowestOpening);
    }
    pictures(seen, images);
  };
}

}  // namespace

Board::Board(const host_sim::Scene& scene, const EmulatorSetup& setup)
    : scene_(scene),
      setup_(setup),
      gpio_(scene.cameras.size()),
      lighting_(scene.cameras.size()),
      times_(1) {}

Board::~Board() {
  if (cameras_) cameras_->stop();
}

Result<void> Board::open_cameras() {
  auto setup = host_sim::setup_of(scene_, setup_.sockets);
  if (!setup) return tl::unexpected(setup.error());
  // One thread: the emulated processors need the others.
  auto bank = host_sim::UsbCameraBank::open(
      *setup, through_irises(lighting_.light(host_sim::pictures_of(scene_, 1)), gpio_));
  if (!bank) return tl::unexpected(bank.error());
  cameras_ = std::move(*bank);
  cameras_->start();
  return {};
}

Result<std::unique_ptr<LineLog>> Board::log_of(const char* socket, LineLog::Listener listener) {
  auto connected = UnixSocket::connect(setup_.sockets / socket, seconds(20));
  if (!connected) return tl::unexpected(connected.error());
  return std::make_unique<LineLog>(
      std::move(*connected), setup_.out / (std::string(socket) + ".log"), std::move(listener));
}

Result<void> Board::connect() {
  const auto open = [&](std::unique_ptr<LineLog>& log, const char* socket,
                        LineLog::Listener listener = {}) -> Result<void> {
    auto opened = log_of(socket, std::move(listener));
    if (!opened) return tl::unexpected(opened.error());
    log = std::move(*opened);
    return {};
  };
  const auto to_gpio = [this](const LoggedLine& line) { gpio_.take(line.text); };
  const auto to_poses = [this](const LoggedLine& line) { poses_.take(line); };
  auto opened = open(shell_line_, kShellSocket);
  if (opened) opened = open(can_, kCanSocket, to_poses);
  if (opened) opened = open(gpio_trace_, kGpioSocket, to_gpio);
  if (opened) opened = open(journal_, kJournalSocket);
  if (opened) shell_ = std::make_unique<GuestShell>(*shell_line_);
  return opened;
}

Result<std::unique_ptr<Board>> Board::power_on(const host_sim::Scene& scene,
                                               const EmulatorSetup& setup) {
  std::unique_ptr<Board> board(new Board(scene, setup));
  if (auto opened = board->open_cameras(); !opened) return tl::unexpected(opened.error());
  board->powered_on_ = host_now();
  auto emulator = Emulator::start(setup);
  if (!emulator) return tl::unexpected(emulator.error());
  board->emulator_ = std::move(*emulator);
  if (auto connected = board->connect(); !connected) return tl::unexpected(connected.error());
  return board;
}

void Board::note_reset() {
  poses_.start_boot();
  gpio_.start_boot();
  times_.emplace_back();
  heard_before_ = shell_line_->bytes();
}

Result<void> Board::set_up_guest() {
  if (auto ready = shell_->wait_until_ready(heard_before_, kBootPatience); !ready) return ready;
  if (auto done = shell_->check(kSetUp, kCommandPatience); !done) {
    return tl::unexpected(done.error());
  }
  return ask_time();
}

Result<void> Board::ask_time() {
  for (int i = 0; i < kTimeQuestions; ++i) {
    const Time asked = host_now();
    auto answer = shell_->check(kAskTime, kCommandPatience);
    const Time answered = host_now();
    if (!answer) return tl::unexpected(answer.error());
    Duration::rep guest_ns = 0;
    const char* end = answer->data() + answer->size();
    if (std::from_chars(answer->data(), end, guest_ns).ptr != end) {
      return fail(fmt::format("the guest's time is \"{}\"; expected nanoseconds", *answer));
    }
    times_.back().add(asked, Time(Duration(guest_ns)), answered);
  }
  if (!times_.back().known()) return fail("the guest's clock does not run at this machine's rate");
  return {};
}

Result<std::string> Board::service(const std::string& property) {
  return shell_->check(fmt::format("systemctl show -p {} --value {}", property, kService),
                       kCommandPatience);
}

}  // namespace dottrack::board
