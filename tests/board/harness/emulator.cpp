#include "tests/board/harness/emulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dottrack::board {
namespace {

constexpr auto kPatience = std::chrono::seconds(20);

using Words = std::vector<std::string>;

void add(Words& command, const Words& words) {
  command.insert(command.end(), words.begin(), words.end());
}

void add_disk(Words& command, const std::filesystem::path& file, const char* name,
              const char* options) {
  add(command,
      {"-drive", fmt::format("file={},if=none,id={},format=raw,{}", file.string(), name, options),
       "-device", fmt::format("virtio-blk-pci,drive={0},serial={0}", name)});
}

void add_socket(Words& command, const EmulatorSetup& setup, const char* name) {
  add(command, {"-chardev", fmt::format("socket,id={0},path={1}/{0},server=on,wait=off", name,
                                        setup.sockets.string())});
}

// A port of virtio-serial, /dev/virtio-ports/dottrack.NAME in the guest.
void add_port(Words& command, const EmulatorSetup& setup, const char* name) {
  add_socket(command, setup, name);
  add(command, {"-device", fmt::format("virtserialport,chardev={0},name=dottrack.{0}", name)});
}

void add_cameras(Words& command, const EmulatorSetup& setup) {
  add(command, {"-device", "qemu-xhci,id=xhci,p2=15,p3=15"});
  for (std::size_t i = 0; i < setup.cameras; ++i) {
    const std::string name = camera_socket(i);
    add(command,
        {"-chardev", fmt::format("socket,id={0},path={1}/{0}", name, setup.sockets.string()),
         "-device", fmt::format("usb-redir,chardev={},bus=xhci.0,port={}", name, i + 1)});
  }
}

std::size_t count_events(const LineLog& log, std::string_view event) {
  const auto lines = log.from(0);
  return static_cast<std::size_t>(std::count_if(
      lines.begin(), lines.end(),
      [&](const LoggedLine& line) { return line.text.find(event) != std::string::npos; }));
}

constexpr std::string_view kReset = "\"event\": \"RESET\"";
constexpr std::string_view kWatchdog = "\"event\": \"WATCHDOG\"";

}  // namespace

std::string camera_socket(std::size_t camera) {
  return fmt::format("cam{}", camera);
}

Words emulator_command(const EmulatorSetup& setup) {
  Words command{"qemu-system-aarch64",
                "-M",
                "virt",
                "-cpu",
                "cortex-a72",
                "-accel",
                "tcg,thread=multi",
                "-smp",
                std::to_string(setup.processors),
                "-m",
                std::to_string(setup.memory_mb),
                "-nographic",
                "-nodefaults",
                "-serial",
                fmt::format("file:{}/console.log", setup.out.string())};
  add(command,
      {"-drive", fmt::format("if=pflash,format=raw,readonly=on,file={}", setup.firmware.string()),
       "-drive", fmt::format("if=pflash,format=raw,file={}", setup.variables.string())});
  add_disk(command, setup.image, "board", "snapshot=on");
  add_disk(command, setup.observer, "observer", "readonly=on");
  for (const char* bus : {"canbus0", "canbus1"}) {
    add(command, {"-object", fmt::format("can-bus,id={}", bus)});
  }
  add(command, {"-device", "kvaser_pci,canbus=canbus0"});  // the unit's
  // The listener's: of another kind, since an emulated kvaser that has received something receives
  // nonsense after a reset. Its second half is on a bus of its own.
  add(command, {"-device", "ctucan_pci,canbus0=canbus0,canbus1=canbus1"});
  add(command, {"-device", "i6300esb", "-action", "watchdog=reset"});
  add_socket(command, setup, kControlSocket);
  add(command, {"-mon", fmt::format("chardev={},mode=control", kControlSocket)});
  add_socket(command, setup, kShellSocket);
  add(command, {"-device", fmt::format("pci-serial,chardev={}", kShellSocket)});
  add(command, {"-device", "virtio-serial-pci"});
  for (const char* name : {kCanSocket, kGpioSocket, kJournalSocket}) add_port(command, setup, name);
  add_cameras(command, setup);
  return command;
}

Result<std::unique_ptr<Emulator>> Emulator::start(const EmulatorSetup& setup) {
  auto process = ChildProcess::start(emulator_command(setup), setup.out / "emulator.log");
  if (!process) return tl::unexpected(process.error());
  auto control = UnixSocket::connect(setup.sockets / kControlSocket, kPatience);
  if (!control) {
    return fail(
        fmt::format("{}; see {}", control.error().message, (setup.out / "emulator.log").string()));
  }
  return std::unique_ptr<Emulator>(
      new Emulator(std::move(*process), std::move(*control), setup.out / "emulator_control.log"));
}

Emulator::Emulator(std::unique_ptr<ChildProcess> process, UnixSocket control,
                   const std::filesystem::path& log)
    : process_(std::move(process)), control_(std::move(control), log) {
  control_.send("{\"execute\": \"qmp_capabilities\"}\n");
}

std::size_t Emulator::resets() const {
  return count_events(control_, kReset);
}

std::size_t Emulator::watchdog_bites() const {
  return count_events(control_, kWatchdog);
}

bool Emulator::wait_for_reset(std::size_t resets_before, Duration patience) const {
  std::size_t seen = 0;
  const auto is_next = [&](std::string_view line) {
    return line.find(kReset) != std::string_view::npos && ++seen > resets_before;
  };
  return control_.wait_for(is_next, 0, patience).has_value();
}

}  // namespace dottrack::board
