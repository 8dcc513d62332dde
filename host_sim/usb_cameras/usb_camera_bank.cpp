#include "host_sim/usb_cameras/usb_camera_bank.h"

#include <fmt/format.h>

#include <utility>

#include "host_sim/usb_cameras/bank.h"

namespace dottrack::host_sim {
namespace {

constexpr int kLargest_px = 8192;
constexpr double kSlowest_hz = 0.01;
constexpr double kFastest_hz = 1000.0;
constexpr std::size_t kLongestName = 64;  // a USB string holds 126 characters

bool printable(const std::string& name) {
  for (const char letter : name) {
    if (letter < ' ' || letter > '~') return false;
  }
  return !name.empty() && name.size() <= kLongestName;
}

Result<void> check(const UsbCameraSetup& setup) {
  if (setup.names.empty()) return fail("USB cameras: no names, expected one a camera");
  for (const std::string& name : setup.names) {
    if (printable(name)) continue;
    return fail(fmt::format("USB cameras: the name \"{}\", expected 1 to {} ASCII characters", name,
                            kLongestName));
  }
  const bool size_possible = setup.width_px > 0 && setup.width_px <= kLargest_px &&
                             setup.height_px > 0 && setup.height_px <= kLargest_px;
  if (!size_possible) {
    return fail(fmt::format("USB cameras: {}x{} pixels, expected 1 to {} each way", setup.width_px,
                            setup.height_px, kLargest_px));
  }
  if (!(setup.frame_rate_hz >= kSlowest_hz && setup.frame_rate_hz <= kFastest_hz)) {
    return fail(fmt::format("USB cameras: {} frames a second, expected {} to {}",
                            setup.frame_rate_hz, kSlowest_hz, kFastest_hz));
  }
  return {};
}

Result<std::vector<std::unique_ptr<CameraPort>>> open_ports(const UsbCameraSetup& setup) {
  std::error_code error;
  std::filesystem::create_directories(setup.folder, error);
  if (error) {
    return fail(fmt::format("{}: cannot make the sockets' folder: {}", setup.folder.string(),
                            error.message()));
  }
  std::vector<std::unique_ptr<CameraPort>> ports;
  for (std::size_t i = 0; i < setup.names.size(); ++i) {
    const UvcFacts facts{.product = "Simulated camera " + setup.names[i],
                         .serial = setup.names[i],
                         .width_px = setup.width_px,
                         .height_px = setup.height_px,
                         .frame_rate_hz = setup.frame_rate_hz};
    auto port = CameraPort::open(setup.folder / fmt::format("cam{}", i), facts, setup.exposure);
    if (!port) return tl::unexpected<Error>(port.error());
    ports.push_back(std::move(*port));
  }
  return ports;
}

}  // namespace

Result<std::unique_ptr<UsbCameraBank>> UsbCameraBank::open(const UsbCameraSetup& setup,
                                                           PictureSource pictures) {
  if (auto possible = check(setup); !possible) return tl::unexpected<Error>(possible.error());
  auto ports = open_ports(setup);
  if (!ports) return tl::unexpected<Error>(ports.error());
  auto bank = Bank::open(setup, std::move(pictures), std::move(*ports));
  if (!bank) return tl::unexpected<Error>(bank.error());
  return std::unique_ptr<UsbCameraBank>(new UsbCameraBank(std::move(*bank)));
}

UsbCameraBank::UsbCameraBank(std::unique_ptr<Bank> bank) : bank_(std::move(bank)) {}

UsbCameraBank::~UsbCameraBank() = default;

void UsbCameraBank::start() {
  bank_->tell([](Bank& bank) { bank.start(); });
}

void UsbCameraBank::stop() {
  bank_->tell([](Bank& bank) { bank.stop(); });
}

void UsbCameraBank::unplug(std::size_t camera) {
  bank_->tell([camera](Bank& bank) { bank.port(camera).unplug(); });
}

void UsbCameraBank::plug_in(std::size_t camera) {
  bank_->tell([camera](Bank& bank) { bank.port(camera).plug_in(); });
}

std::vector<Barrier> UsbCameraBank::barriers() const {
  return bank_->barriers();
}

std::uint64_t UsbCameraBank::late_barriers() const {
  return bank_->late_barriers();
}

std::uint64_t UsbCameraBank::frames_sent(std::size_t camera) const {
  return bank_->condition(camera).frames_sent;
}

std::uint64_t UsbCameraBank::frames_skipped(std::size_t camera) const {
  return bank_->condition(camera).frames_skipped;
}

bool UsbCameraBank::streaming(std::size_t camera) const {
  return bank_->condition(camera).streaming;
}

hal::ExposureSettings UsbCameraBank::exposure(std::size_t camera) const {
  return bank_->condition(camera).exposure;
}

}  // namespace dottrack::host_sim
